#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "wrapatlas/texture.h"

/// PNG or JPEG, whichever the bytes begin like. What was read is written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wrapatlas;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const Result<Texture> texture = decode_texture(bytes, "fuzz");
  if (!texture || texture->texel_count() > (1U << 20U)) return 0;  // large ones take long
  const Result<std::string> written = encode_texture(*texture, 16);
  if (!written) std::abort();
  const Result<Texture> again = decode_texture(*written, "again");
  if (!again || again->values != texture->values) std::abort();
  return 0;
}
