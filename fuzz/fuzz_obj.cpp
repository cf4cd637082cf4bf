#include "fuzz_model.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  wrapatlas::fuzz_shading(std::string(data, data + size), wrapatlas::FileFormat::obj);
  return wrapatlas::fuzz_model(data, size, wrapatlas::FileFormat::obj);
}
