// GLB: chunks, JSON and binary data.
#include <cstddef>
#include <cstdint>

#include "fuzz_model.h"
#include "gltf_round_trip.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  wrapatlas::fuzz_shading(std::string(data, data + size), wrapatlas::FileFormat::glb);
  wrapatlas::fuzz_gltf(std::string(data, data + size), true);
  return 0;
}
