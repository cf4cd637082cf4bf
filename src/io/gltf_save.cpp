#include "io/gltf_save.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "io/file.h"

namespace wrapatlas {
namespace {

namespace fs = std::filesystem;
using Storage = GltfBuffer::Storage;

void add_little_endian(std::string& bytes, std::uint64_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(value >> shift & 255U);
}

class Saver {
 public:
  Saver(const GltfFile& file, GltfEdit& edit, const fs::path& path, bool binary)
      : file_(file), edit_(edit), path_(path), binary_(binary) {
    std::error_code code;
    const fs::file_type type = fs::status(path, code).type();
    beside_ = type == fs::file_type::regular || type == fs::file_type::not_found;
  }

  Status save() {
    if (beside_) relocate_images();
    if (Status placed = place_buffers(); !placed) return placed;
    return binary_ ? save_glb() : write_file(path_, text(2));
  }

 private:
  /// Images stay where they are, so their URIs change with the folder.
  void relocate_images() {
    std::error_code code;
    const fs::path from = fs::absolute(file_.folder.empty() ? "." : file_.folder, code);
    const fs::path to = fs::absolute(path_, code).parent_path();
    if (code || same_file(from, to) || !edit_.json.contains("images")) return;
    for (Json& image : edit_.json["images"]) {
      const Json* uri = find_member(image, "uri");
      if (uri == nullptr || !uri->is_string()) continue;
      const auto& text = uri->get_ref<const std::string&>();
      if (text.starts_with("data:") || !is_plain_relative_uri(text)) continue;
      const fs::path source = from / *percent_decode(text);
      if (!fs::is_regular_file(source, code)) continue;
      const fs::path moved = fs::relative(source, to, code);
      if (!code && !moved.empty()) image["uri"] = percent_encode(moved.generic_string());
    }
  }

  [[nodiscard]] bool is_of_source(const fs::path& path) const {
    return std::any_of(file_.side_files.begin(), file_.side_files.end(),
                       [&](const GltfSideFile& side) { return same_file(side.path, path); });
  }

  fs::path next_side_file() {
    for (;; ++side_count_) {
      const std::string stem = path_.stem().string();
      const std::string name =
          side_count_ == 0 ? stem + ".bin" : fmt::format("{}_{}.bin", stem, side_count_);
      fs::path side = path_.parent_path() / name;
      if (is_of_source(side)) continue;
      ++side_count_;
      return side;
    }
  }

  [[nodiscard]] Storage storage_for(std::size_t buffer) const {
    const Storage storage = edit_.storage(buffer);
    const bool wants_file = storage == Storage::side_file || storage == Storage::bin_chunk;
    if (binary_ && buffer == 0 && storage != Storage::absent) return Storage::bin_chunk;
    return wants_file ? (beside_ ? Storage::side_file : Storage::data_uri) : storage;
  }

  Status place_buffers() {
    for (std::size_t b = 0; b < edit_.buffers().size(); ++b) {
      const Storage storage = storage_for(b);
      if (storage == Storage::absent) continue;
      Json& json = edit_.json["buffers"][b];
      if (storage == Storage::bin_chunk) {
        json.erase("uri");
        continue;
      }
      std::string bytes;
      bytes.reserve(edit_.buffers()[b].size);
      edit_.buffers()[b].append_to(bytes);
      if (storage == Storage::data_uri) {
        json["uri"] = "data:application/octet-stream;base64," + base64_encode(bytes);
        continue;
      }
      const fs::path side = next_side_file();
      if (Status written = write_file(side, bytes); !written) return written;
      json["uri"] = percent_encode(side.filename().string());
    }
    return Done{};
  }

  [[nodiscard]] std::string text(int indent) const {
    return edit_.json.dump(indent, ' ', false, Json::error_handler_t::replace) +
           (indent > 0 ? "\n" : "");
  }

  Status save_glb() {
    std::string json = text(-1);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const bool has_bin = !edit_.buffers().empty() && storage_for(0) == Storage::bin_chunk;
    const std::uint64_t bin_size = has_bin ? (edit_.buffers()[0].size + 3) / 4 * 4 : 0;
    std::uint64_t total = 12 + 8 + json.size() + (has_bin ? 8 + bin_size : 0);
    for (const GlbChunk& chunk : file_.other_chunks) total += 8 + chunk.bytes.size();
    if (total > 0xFFFFFFFFULL) {
      return Error{ErrorKind::output, path_.string(), "a GLB cannot be longer than 4 GiB",
                   "write a .gltf"};
    }
    std::string head = "glTF";
    add_little_endian(head, 2);
    add_little_endian(head, total);
    add_little_endian(head, json.size());
    head += "JSON";
    head += json;
    if (has_bin) {
      add_little_endian(head, bin_size);
      head += std::string_view("BIN\0", 4);
    }
    std::string tail(has_bin ? bin_size - edit_.buffers()[0].size : 0, '\0');
    for (const GlbChunk& chunk : file_.other_chunks) {
      add_little_endian(tail, chunk.bytes.size());
      add_little_endian(tail, chunk.type);
      tail += chunk.bytes;
    }
    return write_file(path_, [&](const PutBytes& put) {
      Status written = put(head);
      if (has_bin) {
        for (const std::string_view piece : edit_.buffers()[0].pieces) {
          if (written) written = put(piece);
        }
      }
      return written ? put(tail) : written;
    });
  }

  const GltfFile& file_;
  GltfEdit& edit_;
  const fs::path& path_;
  bool binary_;
  bool beside_ = true;  ///< the path is a file, so other files can lie beside it
  std::size_t side_count_ = 0;
};

}  // namespace

Status save_gltf(const GltfFile& file, GltfEdit& edit, const fs::path& path, bool binary) {
  return Saver(file, edit, path, binary).save();
}

}  // namespace wrapatlas
