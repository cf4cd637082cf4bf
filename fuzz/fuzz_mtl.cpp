// Material libraries: their maps, and the same with other pictures, which must then be its maps.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "../src/io/mtl.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wrapatlas;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::vector<MtlMap> maps = read_mtl_maps(bytes);
  if (replace_mtl_pictures(bytes, {}) != bytes) std::abort();
  std::map<std::size_t, std::string> pictures;
  for (std::size_t i = 0; i < maps.size(); ++i) pictures[i] = "new " + std::to_string(i) + ".png";
  const std::string replaced = replace_mtl_pictures(bytes, pictures);
  const std::vector<MtlMap> again = read_mtl_maps(replaced);
  if (again.size() != maps.size()) std::abort();
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (again[i].picture != pictures[i] || again[i].keyword != maps[i].keyword) std::abort();
  }
  return 0;
}
