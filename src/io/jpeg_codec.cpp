// By libjpeg-turbo's TurboJPEG interface, whose errors are return values: libjpeg's own leaves
// through longjmp, which C++ objects do not survive.
#include <turbojpeg.h>

#include <memory>

#include "io/image_codecs.h"

namespace wrapatlas {
namespace {

Error decode_error(const std::string& name, tjhandle handle) {
  return {ErrorKind::input, name,
          std::string("not a whole JPEG picture: ") + tjGetErrorStr2(handle), "export it again"};
}

}  // namespace

Result<Texture> decode_jpeg(std::string_view bytes, const std::string& name) {
  const std::unique_ptr<void, decltype(&tjDestroy)> handle(tjInitDecompress(), &tjDestroy);
  if (!handle) return Error{ErrorKind::input, name, "out of memory", "use a smaller picture"};
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0, height = 0, subsampling = 0, color_space = 0;
  if (tjDecompressHeader3(handle.get(), data, bytes.size(), &width, &height, &subsampling,
                          &color_space) != 0) {
    return decode_error(name, handle.get());
  }
  // Each 8 x 8 block has a code of its own, of one bit at least.
  const auto w = static_cast<std::uint64_t>(width), h = static_cast<std::uint64_t>(height);
  if (const Status ok = check_picture_size(name, w, h, w * h / 64 / 8, bytes.size()); !ok) {
    return ok.error();
  }
  const bool grey = color_space == TJCS_GRAY;
  Texture texture(width, height, grey ? 1 : 3);
  std::vector<unsigned char> pixels(texture.values.size());
  if (tjDecompress2(handle.get(), data, bytes.size(), pixels.data(), width, 0, height,
                    grey ? TJPF_GRAY : TJPF_RGB, TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS) != 0) {
    return decode_error(name, handle.get());
  }
  for (std::size_t i = 0; i < pixels.size(); ++i) texture.values[i] = float(pixels[i]) / 255.0F;
  return texture;
}

}  // namespace wrapatlas
