// A glTF 2.0 file in memory: its JSON and the bytes of its buffers.
//
// We use nlohmann::ordered_json itself and no glTF library, for two reasons: on the way back every
// unknown member, extension and extra must be where it was, in its order; and every offset and
// count in the file must have been checked here, by us, before a byte is touched.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wrapatlas/result.h"

namespace wrapatlas {

using Json = nlohmann::ordered_json;

struct GltfBuffer {
  enum class Storage {
    bin_chunk,  ///< of a GLB
    data_uri,
    side_file,
    absent,  ///< no URI: what an extension promises to fill
  };
  Storage storage = Storage::absent;
  std::string_view bytes;  ///< exactly byteLength of them, unless absent
};

/// A chunk of a GLB that is neither JSON nor BIN; kept.
struct GlbChunk {
  std::uint32_t type = 0;
  std::string_view bytes;
};

struct GltfSideFile {
  std::filesystem::path path;
  std::string_view bytes;
};

struct GltfFile {
  std::string name;  ///< stands in errors
  std::filesystem::path folder;
  bool binary = false;
  Json json;
  std::vector<GltfBuffer> buffers;
  std::vector<GlbChunk> other_chunks;
  std::vector<GltfSideFile> side_files;  ///< those the buffers came from
  std::uint64_t byte_count = 0;  ///< of all that was read: the measure for every count in it
  std::vector<std::unique_ptr<std::string>> storage;  ///< what the views above look at

  [[nodiscard]] Error error(std::string_view place, std::string what,
                            std::string remedy = "export the model again") const;
};

/// Takes the container apart, parses the JSON and finds all buffers. Every buffer is loaded, and
/// every buffer view is checked to lie within its buffer. Side files are sought in `base` if it is
/// a folder, else beside it.
Result<GltfFile> open_gltf(std::string bytes, bool binary, std::string_view name,
                           const std::filesystem::path& base);

/// Text to JSON, for text that may be hostile: bounded nesting, bounded members per object.
Result<Json> parse_gltf_json(std::string_view text, std::string_view name);

/// Fills `file.buffers` from "buffers" and the BIN chunk (null if there is none).
Status load_gltf_buffers(GltfFile& file, const std::string_view* bin_chunk);

/// The member `key`, or null if `value` is no object or has no such member.
const Json* find_member(const Json& value, const char* key);

/// The array `key` of `value`; an empty array if it has none.
const Json& array_member(const Json& value, const char* key);

/// A non-negative integer (2.0 is one), or nothing.
std::optional<std::uint64_t> as_integer(const Json& value);

/// The non-negative integer `key` of `value`; `otherwise` if there is no such member; nothing if
/// it is something else.
std::optional<std::uint64_t> integer_member(const Json& value, const char* key,
                                            std::uint64_t otherwise);

/// "%20" to a space and so on; nothing for a broken escape.
std::optional<std::string> percent_decode(std::string_view text);
std::string percent_encode(std::string_view path);
std::string base64_encode(std::string_view bytes);
std::optional<std::string> base64_decode(std::string_view text);

/// Whether `uri` names a file by a path that stays in the folder of the model.
bool is_plain_relative_uri(std::string_view uri);

}  // namespace wrapatlas
