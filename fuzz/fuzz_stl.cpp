#include "fuzz_model.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return wrapatlas::fuzz_model(data, size, wrapatlas::FileFormat::stl);
}
