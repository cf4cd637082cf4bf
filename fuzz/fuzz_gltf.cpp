// glTF as JSON with data URIs.
#include <cstddef>
#include <cstdint>

#include "fuzz_model.h"
#include "gltf_round_trip.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  wrapatlas::fuzz_shading(std::string(data, data + size), wrapatlas::FileFormat::gltf);
  wrapatlas::fuzz_gltf(std::string(data, data + size), false);
  return 0;
}
