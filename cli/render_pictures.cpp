#include "render_pictures.h"

#include <fmt/format.h>

#include <algorithm>

namespace wrapatlas::cli {

Status read_maps(const std::string& path, bool directions, int threads, MipMaps& maps) {
  if (path.empty()) return Done{};
  auto texture = load_texture(path);
  if (!texture) return texture.error();
  if (!directions) srgb_to_linear(*texture, threads);
  if (directions && texture->channels < 3) {
    return Error{ErrorKind::input, path, "a grey picture is no normal map", "give one in colour"};
  }
  maps = make_mip_maps(std::move(*texture), directions ? MipFilter::normals : MipFilter::mean);
  return Done{};
}

Result<Likeness> likeness_to(const std::string& path, const Rendering& rendering, int threads) {
  const auto other = load_texture(path);
  if (!other) return other.error();
  // As it is in the file, or a picture would not be equal to itself.
  const auto bytes = encode_texture(rendering.image);
  if (!bytes) return bytes.error();
  const auto written = decode_texture(*bytes, path);
  if (!written) return written.error();
  const Texture& image = *written;
  if (other->width != image.width || other->height != image.height || other->channels != 3) {
    return Error{ErrorKind::input, path,
                 fmt::format("{} x {} pixels and {} channels, not {} x {} and 3", other->width,
                             other->height, other->channels, image.width, image.height),
                 "render it with the same --size and --views"};
  }
  if (std::find(rendering.covered.begin(), rendering.covered.end(), 1) == rendering.covered.end()) {
    return Error{ErrorKind::input, path, "no pixel shows the model in full", "raise --size"};
  }
  return compare(image, *other, rendering.covered, threads);
}

}  // namespace wrapatlas::cli
