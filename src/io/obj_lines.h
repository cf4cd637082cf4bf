// The lines and words of an OBJ file, as places in its bytes: the reader and the writer both walk
// them, so that what is written differs from what was read only where it must.
#pragma once

#include <cstdint>
#include <string_view>

namespace wrapatlas {

/// A line together with those it goes on in after a backslash.
struct ObjLine {
  std::string_view text;    ///< without its terminator
  std::string_view ending;  ///< "\n", "\r\n", or "" at the end of the file
  std::size_t number = 0;   ///< of its first line, from 1
};

class ObjLines {
 public:
  /// `bytes` must outlive the lines. Skips a byte order mark.
  explicit ObjLines(std::string_view bytes);
  bool next(ObjLine& line);

 private:
  const char* at_;
  const char* end_;
  char terminator_;  // '\n', or '\r' in a file that has no '\n'
  std::size_t number_ = 1;
};

/// The words of one line, up to a comment.
class ObjWords {
 public:
  explicit ObjWords(std::string_view text) : at_(text.data()), end_(at_ + text.size()) {}

  /// The next word, or an empty one (placed where the words end).
  std::string_view next() {
    while (at_ != end_ && is_gap(at_)) ++at_;
    const char* begin = at_;
    if (at_ != end_ && *at_ == '#') return word(begin, begin);
    while (at_ != end_ && !is_gap(at_)) ++at_;
    return word(begin, at_);
  }

 private:
  static std::string_view word(const char* begin, const char* end) {
    return {begin, static_cast<std::size_t>(end - begin)};
  }
  [[nodiscard]] bool is_gap(const char* c) const {
    if (*c > '\\') return false;
    return *c == ' ' || (*c >= '\t' && *c <= '\r') || (*c == '\\' && continues(c + 1));
  }
  [[nodiscard]] bool continues(const char* after) const {
    return after == end_ || *after == '\n' || *after == '\r';
  }
  const char* at_;
  const char* end_;
};

enum class ObjKeyword : std::uint8_t { v, vt, vn, f, o, l, p, curv, surf, other };

/// What a line's first word says; `fo` is an old spelling of `f`.
ObjKeyword obj_keyword(std::string_view word);

/// "v", "v/vt", "v//vn" or "v/vt/vn" as text; absent fields are empty.
struct ObjCorner {
  std::string_view word;
  std::string_view v, vt, vn;
};
ObjCorner split_corner(std::string_view word);

/// The 0-based index that `text` names when `count` items have been defined: negative numbers
/// count back from the last. -1 if it is no number, zero, or before the first.
std::int64_t obj_index(std::string_view text, std::size_t count);

}  // namespace wrapatlas
