// GLB: chunks, JSON and binary data.
#include <cstddef>
#include <cstdint>

#include "gltf_round_trip.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  wrapatlas::fuzz_gltf(std::string(data, data + size), true);
  return 0;
}
