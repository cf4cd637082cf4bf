// Changing the arrays of a glTF: new accessors in, dead ones out, everything else where it was.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/gltf_accessor.h"
#include "io/gltf_json.h"

namespace wrapatlas {

enum class GltfTarget : std::uint16_t { vertices = 34962, indices = 34963 };

/// The bytes of a buffer as it will be written, in pieces.
struct GltfPieces {
  std::vector<std::string_view> pieces;
  std::uint64_t size = 0;

  void add(std::string_view piece) {
    if (piece.empty()) return;
    pieces.push_back(piece);
    size += piece.size();
  }
  /// Adds zeros until the size is `remainder` modulo `alignment` (at most 8).
  void pad(std::uint64_t alignment, std::uint64_t remainder = 0);
  void append_to(std::string& bytes) const {
    for (const std::string_view piece : pieces) bytes += piece;
  }
};

/// A copy of a file's JSON, to be changed, and its new buffers.
///
/// No accessor or buffer view is renumbered, since extensions we do not know may refer to them:
/// new ones take the places of those that died, or are appended.
class GltfEdit {
 public:
  explicit GltfEdit(const GltfFile& file);

  Json json;  ///< accessors and buffer views are for this class to change

  /// Adds an accessor in a buffer view of its own. `accessor` has all its members but bufferView;
  /// each element takes `stride` bytes of `bytes`. Its number holds until finish().
  std::uint64_t add_accessor(Json accessor, std::string bytes, std::size_t stride,
                             GltfTarget target);
  /// The same for tightly packed bytes that stay where they are for as long as this object's
  /// buffers are used.
  std::uint64_t add_accessor(Json accessor, std::string_view bytes, GltfTarget target);

  /// Adds an image, its file's bytes in a buffer view. Returns its number.
  std::uint64_t add_image(const std::string& name, std::string bytes, const char* mime_type);

  /// Drops what only the old data needed, and lays out the buffers. Call it once, last.
  void finish();

  /// Per buffer, after finish(). They look at `file`, at this object and at what it was lent.
  [[nodiscard]] const std::vector<GltfPieces>& buffers() const { return buffers_; }
  [[nodiscard]] GltfBuffer::Storage storage(std::size_t buffer) const { return storage_[buffer]; }

 private:
  struct NewView {
    std::string owned;
    std::string_view lent;   ///< used if nothing is owned
    std::uint64_t view = 0;  ///< its number

    [[nodiscard]] std::string_view bytes() const {
      return owned.empty() ? lent : std::string_view(owned);
    }
  };

  std::uint64_t add_array(Json accessor, NewView bytes, std::size_t stride, GltfTarget target);

  void drop_stale_extensions();
  std::vector<std::uint64_t> move_into(const char* directory, std::uint64_t first_new,
                                       std::vector<std::uint64_t> dead);
  void lay_out(const std::vector<bool>& view_died);
  void drop_empty_buffers();
  void copy_live_ranges(std::uint64_t buffer, const std::vector<bool>& view_died);

  const GltfFile& file_;
  std::uint64_t old_accessors_, old_views_;
  std::vector<NewView> new_views_;
  std::vector<std::uint64_t> final_number_;  ///< of accessors, after dead ones were replaced
  std::vector<GltfPieces> buffers_;
  std::vector<GltfBuffer::Storage> storage_;
};

}  // namespace wrapatlas
