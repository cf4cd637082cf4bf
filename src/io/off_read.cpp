// OFF (Geomview's object file format): polygons, and UVs per vertex in its ST variant. Normals and
// colours are skipped.
#include <fmt/format.h>

#include <array>
#include <utility>

#include "io/formats.h"
#include "io/number.h"
#include "io/text_words.h"

namespace wrapatlas {
namespace {

class OffReader {
 public:
  OffReader(std::string_view bytes, std::string_view name) : words_(bytes), name_(name) {
    words_.allow_comments();
  }

  Result<Model> read() {
    if (!read_header() || !read_vertices() || !read_faces()) {
      return Error{ErrorKind::input, fmt::format("{}:{}", name_, words_.line()), what_, remedy_};
    }
    if (left_aside_ > 0) {
      model_.remarks.push_back(
          fmt::format("left aside {} faces of fewer than three corners, the "
                      "first in line {}",
                      left_aside_, first_left_aside_));
    }
    model_.format = FileFormat::off;
    return std::move(model_);
  }

 private:
  bool fail(std::string what, std::string remedy = "export the mesh again") {
    what_ = std::move(what);
    remedy_ = std::move(remedy);
    return false;
  }
  bool bad_word(std::string_view word, const char* wanted) {
    if (word.empty()) return fail(fmt::format("{} is missing", wanted));
    return fail(fmt::format("'{}' is not {}", word.substr(0, 40), wanted));
  }

  // [ST][C][N]OFF, which may be missing altogether.
  bool read_header() {
    std::string_view word = words_.next();
    if (word.substr(0, 3) == "\xEF\xBB\xBF") word.remove_prefix(3);
    if (word.size() >= 3 && word.substr(word.size() - 3) == "OFF") {
      std::string_view flags = word.substr(0, word.size() - 3);
      const auto take = [&](std::string_view flag) {
        const bool found = flags.substr(0, flag.size()) == flag;
        if (found) flags.remove_prefix(flag.size());
        return found;
      };
      has_texcoords_ = take("ST");
      has_colors_ = take("C");
      has_normals_ = take("N");
      if (!flags.empty()) {
        return fail(fmt::format("'{}' is a variant of OFF that is not three-dimensional",
                                word.substr(0, 40)));
      }
      word = words_.next();
    }
    if (word == "BINARY") return fail("binary OFF cannot be read", "save it as text");
    return read_count(word, "the number of vertices", 6, vertex_count_) &&
           read_count(words_.next(), "the number of faces", 2, face_count_) && skip_edge_count();
  }

  bool read_count(std::string_view word, const char* wanted, std::size_t bytes_each,
                  std::size_t& count) {
    std::int64_t number = 0;
    if (!parse_integer(word, number) || number < 0) return bad_word(word, wanted);
    count = static_cast<std::size_t>(number);
    if (number >= kNone || count > words_.bytes_left() / bytes_each + 1) {
      return fail(fmt::format("{} is {}, more than the file has bytes for", wanted, number),
                  "the file is cut short: get it again");
    }
    return true;
  }
  bool skip_edge_count() {
    words_.skip_line();
    return true;
  }

  bool read_coordinate(std::string_view word, double& value) {
    return parse_coordinate(word, value) || bad_word(word, "a usable coordinate");
  }

  bool read_vertices() {
    Mesh& mesh = model_.mesh;
    mesh.positions.resize(vertex_count_);
    if (has_texcoords_) mesh.texcoords.resize(vertex_count_);
    for (std::size_t i = 0; i < vertex_count_; ++i) {
      Vec3& p = mesh.positions[i];
      for (double* value : {&p.x, &p.y, &p.z}) {
        if (!read_coordinate(words_.next(), *value)) return false;
      }
      if (has_normals_) {
        for (int k = 0; k < 3; ++k) words_.next();
      }
      // A colour is three or four numbers, so what follows it is found from the end of the line.
      std::array<std::string_view, 2> last;
      for (;;) {
        const bool line_based = has_colors_ || has_texcoords_;
        const std::string_view word = line_based ? words_.next_on_line() : std::string_view();
        if (word.empty()) break;
        last = {last[1], word};
      }
      if (!has_texcoords_) continue;
      Vec2& uv = mesh.texcoords[i];
      if (!read_coordinate(last[0], uv.x) || !read_coordinate(last[1], uv.y)) return false;
    }
    return true;
  }

  bool read_faces() {
    Mesh& mesh = model_.mesh;
    mesh.face_begin.reserve(face_count_ + 1);
    for (std::size_t face = 0; face < face_count_; ++face) {
      const std::string_view word = words_.next();
      std::int64_t size = 0;
      if (!parse_integer(word, size) || size < 0) return bad_word(word, "a number of corners");
      const std::size_t begin = mesh.corner_position.size();
      for (std::int64_t k = 0; k < size; ++k) {
        const std::string_view text = words_.next();
        std::int64_t index = 0;
        if (!parse_integer(text, index)) return bad_word(text, "a vertex number");
        if (index < 0 || static_cast<std::size_t>(index) >= vertex_count_) {
          return fail(fmt::format("the face refers to vertex {} of {}", index, vertex_count_));
        }
        mesh.corner_position.push_back(static_cast<std::uint32_t>(index));
      }
      if (mesh.corner_position.size() >= kNone) return fail("there are too many faces");
      if (size < 3) {
        if (left_aside_++ == 0) first_left_aside_ = words_.line();
        mesh.corner_position.resize(begin);
      } else {
        mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
      }
      words_.skip_line();  // a colour may follow
    }
    if (has_texcoords_) {
      mesh.corner_texcoord = mesh.corner_position;
    } else {
      mesh.corner_texcoord.assign(mesh.corner_position.size(), kNone);
    }
    return true;
  }

  TextWords words_;
  std::string_view name_;
  Model model_;
  bool has_texcoords_ = false, has_colors_ = false, has_normals_ = false;
  std::size_t vertex_count_ = 0, face_count_ = 0;
  std::size_t left_aside_ = 0, first_left_aside_ = 0;
  std::string what_, remedy_;
};

}  // namespace

Result<Model> read_off(const std::string& bytes, std::string_view name) {
  return OffReader(bytes, name).read();
}

}  // namespace wrapatlas
