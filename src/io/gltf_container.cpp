// The container: GLB chunks, buffers and buffer views.
#include <fmt/format.h>

#include <cstring>
#include <system_error>

#include "io/file.h"
#include "io/gltf_json.h"

namespace wrapatlas {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004E4942;   // "BIN"

std::uint32_t little_endian_32(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) {
    value = value << 8U | static_cast<unsigned char>(bytes[offset + i]);
  }
  return value;
}

struct Chunks {
  std::string_view json;
  std::optional<std::string_view> bin;
};

Result<Chunks> split_glb(std::string_view bytes, GltfFile& file) {
  if (bytes.size() < 20 || little_endian_32(bytes, 0) != kMagic) {
    return file.error("", "it is not a GLB file", "check the ending of its name");
  }
  if (little_endian_32(bytes, 4) != 2) {
    return file.error("",
                      fmt::format("GLB version {} is not supported", little_endian_32(bytes, 4)),
                      "export it as glTF 2.0");
  }
  const std::uint64_t length = little_endian_32(bytes, 8);
  if (length > bytes.size() || length < 20) {
    return file.error("", fmt::format("it is {} bytes long but says {}", bytes.size(), length),
                      "the file is damaged or cut off: copy or export it again");
  }
  Chunks chunks;
  std::size_t offset = 12;
  for (int index = 0; offset + 8 <= length; ++index) {
    const std::uint64_t size = little_endian_32(bytes, offset);
    const std::uint32_t type = little_endian_32(bytes, offset + 4);
    offset += 8;
    if (size > length - offset) {
      return file.error(fmt::format("chunk {}", index), "it ends beyond the end of the file",
                        "the file is damaged or cut off: copy or export it again");
    }
    const std::string_view content = bytes.substr(offset, size);
    offset += size;
    if (index == 0) {
      if (type != kJsonChunk) return file.error("chunk 0", "it is not JSON");
      chunks.json = content;
    } else if (type == kBinChunk && index == 1) {
      chunks.bin = content;
    } else {
      file.other_chunks.push_back({type, content});
    }
  }
  return chunks;
}

Result<std::string_view> side_file(GltfFile& file, std::string_view place, const std::string& uri) {
  const std::optional<std::string> decoded = percent_decode(uri);
  if (!decoded || !is_plain_relative_uri(uri)) {
    return file.error(place,
                      fmt::format("URI \"{}\" is not a file beside the model", uri.substr(0, 100)),
                      "put the file into the model's folder, or convert the model to .glb");
  }
  const std::filesystem::path path = file.folder / *decoded;
  for (const GltfSideFile& known : file.side_files) {
    if (known.path == path) return known.bytes;
  }
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code)) {
    return file.error(place, fmt::format("there is no file {}", path.string()),
                      "put it beside the model, or convert the model to .glb");
  }
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  file.storage.push_back(std::make_unique<std::string>(*std::move(bytes)));
  file.side_files.push_back({path, *file.storage.back()});
  file.byte_count += file.storage.back()->size();
  return file.side_files.back().bytes;
}

Result<std::string_view> data_uri(GltfFile& file, std::string_view place, std::string_view uri) {
  const std::size_t comma = uri.find(',');
  std::optional<std::string> bytes;
  if (comma != std::string_view::npos) {
    const std::string_view content = uri.substr(comma + 1);
    const bool base64 = uri.substr(0, comma).ends_with(";base64");
    bytes = base64 ? base64_decode(content) : percent_decode(content);
  }
  if (!bytes) return file.error(place, "its data URI cannot be decoded");
  file.storage.push_back(std::make_unique<std::string>(*std::move(bytes)));
  return std::string_view(*file.storage.back());
}

Status check_buffer_views(const GltfFile& file) {
  const Json& views = array_member(file.json, "bufferViews");
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Json& view = views[i];
    const std::string place = fmt::format("bufferView {}", i);
    const auto buffer = integer_member(view, "buffer", ~0ULL);
    if (!buffer || *buffer >= file.buffers.size()) {
      return file.error(place, fmt::format("it names no buffer of the {}", file.buffers.size()));
    }
    if (file.buffers[*buffer].storage == GltfBuffer::Storage::absent) {
      const Json* extensions = find_member(view, "extensions");
      if (extensions == nullptr || !extensions->is_object() || extensions->empty()) {
        return file.error(place, fmt::format("buffer {} has no data", *buffer));
      }
      return file.error(place,
                        fmt::format("its data is compressed by {}", extensions->begin().key()),
                        "decompress it first, e.g. with gltf-transform");
    }
    const auto offset = integer_member(view, "byteOffset", 0);
    const auto length = integer_member(view, "byteLength", 0);
    const auto stride = integer_member(view, "byteStride", 4);
    if (!offset || !length || *length == 0 || !stride || *stride < 1 || *stride > 252) {
      return file.error(place, "its offset, length or stride is missing or out of range");
    }
    const std::size_t size = file.buffers[*buffer].bytes.size();
    if (*offset > size || *length > size - *offset) {
      return file.error(place, fmt::format("bytes {} to {} lie outside of buffer {}, which has {}",
                                           *offset, *offset + *length, *buffer, size));
    }
  }
  return Done{};
}

}  // namespace

Status load_gltf_buffers(GltfFile& file, const std::string_view* bin_chunk) {
  const Json& buffers = array_member(file.json, "buffers");
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    const std::string place = fmt::format("buffer {}", i);
    const auto length = integer_member(buffers[i], "byteLength", 0);
    if (!length || *length == 0)
      return file.error(place, "its byteLength is missing or not positive");
    GltfBuffer buffer;
    const Json* uri = find_member(buffers[i], "uri");
    if (uri == nullptr) {
      if (i == 0 && bin_chunk != nullptr) {
        buffer = {GltfBuffer::Storage::bin_chunk, *bin_chunk};
      }
    } else if (!uri->is_string()) {
      return file.error(place, "its uri is not a string");
    } else {
      const auto& text = uri->get_ref<const std::string&>();
      const bool data = text.starts_with("data:");
      auto bytes = data ? data_uri(file, place, text) : side_file(file, place, text);
      if (!bytes) return bytes.error();
      buffer = {data ? GltfBuffer::Storage::data_uri : GltfBuffer::Storage::side_file, *bytes};
    }
    if (buffer.storage != GltfBuffer::Storage::absent) {
      if (buffer.bytes.size() < *length) {
        return file.error(place,
                          fmt::format("it has {} bytes but says {}", buffer.bytes.size(), *length),
                          "the file is damaged or cut off: copy or export it again");
      }
      buffer.bytes = buffer.bytes.substr(0, *length);
    }
    file.buffers.push_back(buffer);
  }
  return Done{};
}

Result<GltfFile> open_gltf(std::string bytes, bool binary, std::string_view name,
                           const std::filesystem::path& base) {
  GltfFile file;
  file.name = name;
  file.binary = binary;
  std::error_code code;
  file.folder = std::filesystem::is_directory(base, code) ? base : base.parent_path();
  file.byte_count = bytes.size();
  file.storage.push_back(std::make_unique<std::string>(std::move(bytes)));
  Chunks chunks{*file.storage.back(), {}};
  if (binary) {
    Result<Chunks> split = split_glb(chunks.json, file);
    if (!split) return split.error();
    chunks = *split;
  }
  if (chunks.json.starts_with("\xEF\xBB\xBF")) chunks.json.remove_prefix(3);
  Result<Json> json = parse_gltf_json(chunks.json, name);
  if (!json) return json.error();
  file.json = *std::move(json);
  if (!binary) file.storage.clear();

  const Json* asset = find_member(file.json, "asset");
  const Json* version = asset != nullptr ? find_member(*asset, "version") : nullptr;
  if (version == nullptr || !version->is_string() ||
      !version->get_ref<const std::string&>().starts_with("2.")) {
    return file.error("asset", "its version is not 2.x", "export it as glTF 2.0");
  }
  const Status loaded = load_gltf_buffers(file, chunks.bin ? &*chunks.bin : nullptr);
  if (!loaded) return loaded.error();
  const Status checked = check_buffer_views(file);
  if (!checked) return checked.error();
  return file;
}

}  // namespace wrapatlas
