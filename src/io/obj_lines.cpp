#include "io/obj_lines.h"

#include <cstring>

#include "io/number.h"

namespace wrapatlas {
namespace {

bool has_comment(const char* begin, const char* end) {
  for (const char* c = begin; c != end; ++c) {
    if (*c == '#' && (c == begin || c[-1] == ' ' || c[-1] == '\t')) return true;
  }
  return false;
}

}  // namespace

ObjLines::ObjLines(std::string_view bytes)
    : at_(bytes.data()), end_(bytes.data() + bytes.size()), terminator_('\n') {
  if (bytes.substr(0, 3) == "\xEF\xBB\xBF") at_ += 3;
  if (bytes.find('\n') == std::string_view::npos) terminator_ = '\r';
}

bool ObjLines::next(ObjLine& line) {
  if (at_ == end_) return false;
  line.number = number_;
  const char* begin = at_;
  const char* segment = at_;
  for (;;) {
    const auto left = static_cast<std::size_t>(end_ - segment);
    const void* found = left == 0 ? nullptr : std::memchr(segment, terminator_, left);
    const char* stop = found == nullptr ? end_ : static_cast<const char*>(found);
    const char* text_end = stop;
    if (stop != end_ && text_end != segment && text_end[-1] == '\r') --text_end;
    ++number_;
    const bool goes_on = stop != end_ && text_end != segment && text_end[-1] == '\\' &&
                         !has_comment(segment, text_end);
    if (goes_on) {
      segment = stop + 1;
      continue;
    }
    at_ = stop == end_ ? end_ : stop + 1;
    line.text = {begin, static_cast<std::size_t>(text_end - begin)};
    line.ending = {text_end, static_cast<std::size_t>(at_ - text_end)};
    return true;
  }
}

ObjKeyword obj_keyword(std::string_view word) {
  if (word.size() == 1) {
    switch (word[0]) {
      case 'v':
        return ObjKeyword::v;
      case 'f':
        return ObjKeyword::f;
      case 'o':
        return ObjKeyword::o;
      case 'l':
        return ObjKeyword::l;
      case 'p':
        return ObjKeyword::p;
      default:
        return ObjKeyword::other;
    }
  }
  if (word == "vt") return ObjKeyword::vt;
  if (word == "vn") return ObjKeyword::vn;
  if (word == "fo") return ObjKeyword::f;
  if (word == "curv") return ObjKeyword::curv;
  if (word == "surf") return ObjKeyword::surf;
  return ObjKeyword::other;
}

ObjCorner split_corner(std::string_view word) {
  ObjCorner corner{word, word, {}, {}};
  const char* end = word.data() + word.size();
  const char* slash = word.data();
  while (slash != end && *slash != '/') ++slash;
  corner.v = {word.data(), static_cast<std::size_t>(slash - word.data())};
  if (slash == end) return corner;
  const char* second = slash + 1;
  while (second != end && *second != '/') ++second;
  corner.vt = {slash + 1, static_cast<std::size_t>(second - slash - 1)};
  if (second != end) corner.vn = {second + 1, static_cast<std::size_t>(end - second - 1)};
  return corner;
}

std::int64_t obj_index(std::string_view text, std::size_t count) {
  std::int64_t number = 0;
  if (!parse_integer(text, number) || number == 0) return -1;
  if (number > 0) return number - 1;
  const std::int64_t index = static_cast<std::int64_t>(count) + number;
  return index < 0 ? -1 : index;
}

}  // namespace wrapatlas
