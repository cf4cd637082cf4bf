// STL, text and binary: triangles without connectivity. Corners of bit-equal position become one
// vertex.
#include <fmt/format.h>

#include <bit>
#include <cctype>
#include <cstring>
#include <utility>

#include "io/formats.h"
#include "io/number.h"
#include "io/text_words.h"

namespace wrapatlas {
namespace {

constexpr std::size_t kHeaderBytes = 84, kTriangleBytes = 50;

std::uint32_t little_u32(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8U | static_cast<unsigned char>(bytes[i]);
  return value;
}

bool is_word(std::string_view word, std::string_view lower_case) {
  if (word.size() != lower_case.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (std::tolower(static_cast<unsigned char>(word[i])) != lower_case[i]) return false;
  }
  return true;
}

// From one position per corner to shared ones, numbered by their first corners.
void weld(Mesh& mesh) {
  const std::vector<std::uint32_t> first = weld_positions(mesh.positions);
  std::vector<std::uint32_t> number(first.size());
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    if (first[i] == i) {
      mesh.positions[count] = mesh.positions[i];
      number[i] = count++;
    } else {
      number[i] = number[first[i]];
    }
  }
  mesh.positions.resize(count);
  mesh.positions.shrink_to_fit();
  mesh.corner_texcoord.assign(number.size(), kNone);
  mesh.corner_position = std::move(number);
}

/// Text has no zeros. A binary header is filled up with them; if it is not, the count behind it has
/// one for
/// all but huge files.
bool has_binary_header(std::string_view bytes) {
  return bytes.substr(0, kHeaderBytes).find('\0') != std::string_view::npos;
}

Result<Model> read_binary(std::string_view bytes, std::string_view name) {
  const std::size_t count = little_u32(bytes.data() + 80);
  if (count >= kNone / 3) {
    return Error{ErrorKind::input, std::string(name),
                 fmt::format("{} triangles are too many", count), "split the file"};
  }
  Model model;
  model.format = FileFormat::stl;
  if (bytes.size() > kHeaderBytes + count * kTriangleBytes) {
    model.remarks.push_back(fmt::format("left aside {} bytes after the last triangle",
                                        bytes.size() - kHeaderBytes - count * kTriangleBytes));
  }
  Mesh& mesh = model.mesh;
  mesh.positions.reserve(3 * count);
  mesh.face_begin.reserve(count + 1);
  for (std::size_t triangle = 0; triangle < count; ++triangle) {
    const char* at = bytes.data() + kHeaderBytes + triangle * kTriangleBytes + 12;
    for (int corner = 0; corner < 3; ++corner) {
      Vec3 p;
      for (double* value : {&p.x, &p.y, &p.z}) {
        *value = double{std::bit_cast<float>(little_u32(at))};
        at += 4;
        if (!(std::abs(*value) < kCoordinateLimit)) {
          return Error{ErrorKind::input, fmt::format("{}: triangle {}", name, triangle),
                       "a coordinate is not a usable number",
                       "export the mesh again without NaN, infinite or huge values"};
        }
      }
      mesh.positions.push_back(p);
    }
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
  }
  weld(mesh);
  return model;
}

class TextStlReader {
 public:
  TextStlReader(std::string_view bytes, std::string_view name) : words_(bytes), name_(name) {}

  Result<Model> read() {
    bool ended = false;
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
      if (is_word(word, "solid") || is_word(word, "endsolid")) {
        ended = is_word(word, "endsolid");
        words_.skip_line();  // a name, of any words
      } else if (!is_word(word, "facet") || !read_facet()) {
        if (what_.empty()) fail(fmt::format("'{}' is not 'facet'", word.substr(0, 40)));
        return Error{ErrorKind::input, fmt::format("{}:{}", name_, words_.line()), what_,
                     "export the mesh again"};
      }
    }
    if (!ended) model_.remarks.emplace_back("the file ends without 'endsolid'");
    weld(model_.mesh);
    model_.format = FileFormat::stl;
    return std::move(model_);
  }

 private:
  bool fail(std::string what) {
    what_ = std::move(what);
    return false;
  }
  bool expect(std::string_view wanted) {
    const std::string_view word = words_.next();
    if (is_word(word, wanted)) return true;
    if (word.empty()) return fail(fmt::format("the file ends where '{}' should follow", wanted));
    return fail(fmt::format("'{}' is not '{}'", word.substr(0, 40), wanted));
  }
  bool read_facet() {
    if (!expect("normal")) return false;
    for (int i = 0; i < 3; ++i) words_.next();
    if (!expect("outer") || !expect("loop")) return false;
    for (int corner = 0; corner < 3; ++corner) {
      if (!expect("vertex")) return false;
      Vec3 p;
      for (double* value : {&p.x, &p.y, &p.z}) {
        const std::string_view word = words_.next();
        if (!parse_coordinate(word, *value)) {
          return fail(fmt::format("'{}' is not a usable coordinate", word.substr(0, 40)));
        }
      }
      model_.mesh.positions.push_back(p);
    }
    if (!expect("endloop") || !expect("endfacet")) return false;
    if (model_.mesh.positions.size() >= kNone) return fail("there are too many triangles");
    model_.mesh.face_begin.push_back(static_cast<std::uint32_t>(model_.mesh.positions.size()));
    return true;
  }

  TextWords words_;
  std::string_view name_;
  Model model_;
  std::string what_;
};

}  // namespace

Result<Model> read_stl(std::string bytes, std::string_view name) {
  // Binary files may start with "solid" too, so the size decides where it can.
  const std::size_t size = bytes.size();
  const std::size_t wanted =
      size < kHeaderBytes ? 0 : kHeaderBytes + kTriangleBytes * little_u32(bytes.data() + 80);
  if (wanted != 0 && size == wanted) return read_binary(bytes, name);
  if (is_word(TextWords(bytes).next(), "solid")) {
    Result<Model> text = TextStlReader(bytes, name).read();
    const bool has_faces = text && text->mesh.face_count() > 0;
    if (has_faces || !has_binary_header(bytes)) return text;
  }
  if (wanted != 0 && size > wanted) return read_binary(bytes, name);
  return Error{ErrorKind::input, std::string(name),
               wanted == 0 ? "the file is no STL: too short, and no text that begins with 'solid'"
                           : fmt::format("a binary STL of this many triangles has {} bytes, the "
                                         "file has {}",
                                         wanted, size),
               "the file is cut short: get it again"};
}

}  // namespace wrapatlas
