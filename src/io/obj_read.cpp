// Wavefront OBJ: polygons with positions and UVs. Everything else stays in the bytes, which are
// kept to write the file back.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "io/face_labels.h"
#include "io/formats.h"
#include "io/number.h"
#include "io/obj_lines.h"
#include "io/obj_source.h"
#include "mesh/polygon_plane.h"
#include "wrapatlas/texture.h"

namespace wrapatlas {
namespace {

class ObjReader {
 public:
  ObjReader(std::string_view bytes, std::string_view name, bool shading)
      : bytes_(bytes), name_(name), shading_(shading) {}

  Result<Mesh> read() {
    ObjLines lines(bytes_);
    for (ObjLine line; lines.next(line);) {
      ObjWords words(line.text);
      bool fine = true;
      const std::string_view first = words.next();
      switch (obj_keyword(first)) {
        case ObjKeyword::v:
          fine = read_position(words);
          break;
        case ObjKeyword::vt:
          fine = read_texcoord(words);
          break;
        case ObjKeyword::vn:
          ++normal_count_;
          if (shading_) read_normal(words);
          break;
        case ObjKeyword::f:
          fine = read_face(words);
          break;
        case ObjKeyword::o:
          objects_.rename(mesh_.face_object, mesh_.face_count(), rest_of_line(words, line.text));
          break;
        default:
          if (first == "mtllib") read_material_file(words);
          if (first == "usemtl") {
            materials_.rename(face_material_, mesh_.face_count(), rest_of_line(words, line.text));
          }
          break;
      }
      if (!fine) return error_at(line.number);
    }
    objects_.rename(mesh_.face_object, mesh_.face_count(), {});
    materials_.rename(face_material_, mesh_.face_count(), {});
    return check_forward_references();
  }
  void move_normals_to(Model& model) {
    if (normals_.empty()) return;
    for (const std::uint32_t normal : corner_normal_) {
      model.corner_normal.push_back(normal == kNone ? Vec3{} : unit(normals_[normal]));
    }
  }
  void move_colors_to(Model& model) {
    if (colors_.empty()) return;
    colors_.resize(model.mesh.positions.size(), {1, 1, 1});
    for (const std::uint32_t i : model.mesh.corner_position) {
      model.corner_color.push_back(colors_[i]);
    }
  }
  void move_materials_to(Model& model, ObjSource& source) {
    model.face_material = std::move(face_material_);
    for (const std::string_view name : materials_.names()) source.materials.emplace_back(name);
    source.material_files = material_files_;
    model.material_files = std::move(material_files_);
  }

 private:
  bool fail(std::string what, std::string remedy) {
    what_ = std::move(what);
    remedy_ = std::move(remedy);
    return false;
  }
  Error error_at(std::size_t line) {
    return {ErrorKind::input, fmt::format("{}:{}", name_, line), what_, remedy_};
  }

  bool bad_coordinate(std::string_view word) {
    if (word.empty()) return fail("a coordinate is missing", "export the mesh again");
    return fail(fmt::format("'{}' is not a usable coordinate", word.substr(0, 40)),
                "export the mesh again without NaN, infinite or huge values");
  }

  /// From the first word to the last: names may hold spaces.
  void read_material_file(ObjWords& words) {
    const std::string_view first = words.next();
    std::string_view last = first;
    for (std::string_view word = first; !word.empty(); word = words.next()) last = word;
    if (!first.empty()) material_files_.emplace_back(first.data(), last.data() + last.size());
  }

  bool read_position(ObjWords& words) {
    Vec3 p;
    for (double* value : {&p.x, &p.y, &p.z}) {
      const std::string_view word = words.next();
      if (!parse_coordinate(word, *value)) return bad_coordinate(word);
    }
    mesh_.positions.push_back(p);
    if (shading_) read_color(words);
    return mesh_.positions.size() < kNone || fail("there are too many vertices", "split the file");
  }

  /// One that is no vector is none.
  void read_normal(ObjWords& words) {
    Vec3 n;
    bool usable = true;
    for (double* value : {&n.x, &n.y, &n.z}) {
      usable = usable && parse_coordinate(words.next(), *value);
    }
    normals_.push_back(usable ? n : Vec3{});
  }

  /// Many programs write a vertex's colour, sRGB, after its position. A fourth number alone is a
  /// weight.
  void read_color(ObjWords& words) {
    std::array<double, 3> value{};
    std::size_t count = 0;
    for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++count) {
      if (count >= 3 || !parse_coordinate(word, value[count])) return;
    }
    if (count != 3) return;
    colors_.resize(mesh_.positions.size(), {1, 1, 1});
    for (std::size_t i = 0; i < 3; ++i) {
      colors_.back()[i] = srgb_to_linear(static_cast<float>(std::clamp(value[i], 0.0, 1.0)));
    }
  }

  bool read_texcoord(ObjWords& words) {
    Vec2 uv;
    const std::string_view u = words.next(), v = words.next();
    if (!parse_coordinate(u, uv.x)) return bad_coordinate(u);
    if (!v.empty() && !parse_coordinate(v, uv.y)) return bad_coordinate(v);
    mesh_.texcoords.push_back(uv);
    return mesh_.texcoords.size() < kNone || fail("there are too many UVs", "split the file");
  }

  /// A name may hold blanks.
  static std::string_view rest_of_line(ObjWords& words, std::string_view line) {
    const std::string_view first = words.next();
    std::string_view last = first;
    for (std::string_view word = first; !word.empty(); word = words.next()) last = word;
    return line.substr(static_cast<std::size_t>(first.data() - line.data()),
                       static_cast<std::size_t>(last.data() + last.size() - first.data()));
  }

  // Items may be defined after the face that uses them, so only the kind of number is checked here.
  bool read_index(std::string_view text, std::size_t count, std::uint32_t& index) {
    const std::int64_t parsed = obj_index(text, count);
    index = static_cast<std::uint32_t>(parsed);
    if (parsed >= 0 && parsed < kNone) return true;
    return fail(fmt::format("'{}' is not a valid index", text.substr(0, 40)),
                "export the mesh again");
  }

  bool read_face(ObjWords& words) {
    const std::size_t begin = mesh_.corner_position.size();
    std::string_view open_ended;  // the last corner that is
    std::size_t open_ends = 0;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      const ObjCorner corner = split_corner(word);
      std::uint32_t position = 0, texcoord = kNone, normal = 0;
      if (!read_index(corner.v, mesh_.positions.size(), position)) return false;
      if (!corner.vt.empty() && !read_index(corner.vt, mesh_.texcoords.size(), texcoord)) {
        return false;
      }
      if (!corner.vn.empty()) {
        if (!read_index(corner.vn, normal_count_, normal)) return false;
        if (normal >= normals_needed_) {
          normals_needed_ = normal + std::size_t{1};
          face_of_last_normal_ = mesh_.face_count();
        }
      }
      if (word.ends_with('/')) {
        open_ended = word;
        ++open_ends;
      }
      if (shading_) corner_normal_.push_back(corner.vn.empty() ? kNone : normal);
      mesh_.corner_position.push_back(position);
      mesh_.corner_texcoord.push_back(texcoord);
    }
    const std::size_t corners = mesh_.corner_position.size();
    if (corners < begin + 3) {
      return fail(fmt::format("a face needs three corners and has {}", corners - begin),
                  "remove the face");
    }
    if (corners >= kNone) return fail("there are too many faces", "split the file");
    // Some programs write "1/" or "1//" where there is no more to say, but then in all corners.
    if (open_ends != 0 && open_ends != corners - begin) {
      return fail(fmt::format("nothing follows the slash of '{}'", open_ended.substr(0, 40)),
                  "the file is damaged or cut off: copy or export it again");
    }
    mesh_.face_begin.push_back(static_cast<std::uint32_t>(corners));
    return true;
  }

  Result<Mesh> check_forward_references() {
    for (std::size_t face = 0; face < mesh_.face_count(); ++face) {
      for (std::uint32_t c = mesh_.face_begin[face]; c < mesh_.face_begin[face + 1]; ++c) {
        const std::uint32_t position = mesh_.corner_position[c];
        const std::uint32_t texcoord = mesh_.corner_texcoord[c];
        if (position >= mesh_.positions.size()) {
          return out_of_range(face, "vertex", position, mesh_.positions.size());
        }
        if (texcoord != kNone && texcoord >= mesh_.texcoords.size()) {
          return out_of_range(face, "texture coordinate", texcoord, mesh_.texcoords.size());
        }
      }
    }
    if (normals_needed_ > normal_count_) {
      return out_of_range(face_of_last_normal_, "normal", normals_needed_ - 1, normal_count_);
    }
    return std::move(mesh_);
  }

  Error out_of_range(std::size_t face, const char* kind, std::size_t index, std::size_t count) {
    fail(fmt::format("the face refers to {} {} of {}", kind, index + 1, count),
         "export the mesh again");
    ObjLines lines(bytes_);
    for (ObjLine line; lines.next(line);) {
      if (obj_keyword(ObjWords(line.text).next()) != ObjKeyword::f) continue;
      if (face-- == 0) return error_at(line.number);
    }
    return error_at(0);
  }

  std::string_view bytes_, name_;
  bool shading_;
  std::vector<Vec3> normals_;
  std::vector<std::uint32_t> corner_normal_;  // into normals_, or kNone
  std::vector<std::string> material_files_;
  Mesh mesh_;
  std::vector<std::array<float, 3>> colors_;
  NamedLabels objects_, materials_;
  std::vector<std::uint32_t> face_material_;
  std::size_t normal_count_ = 0, normals_needed_ = 0, face_of_last_normal_ = 0;
  std::string what_, remedy_;
};

}  // namespace

Result<Model> read_obj(std::string bytes, std::string_view name, const std::filesystem::path& base,
                       bool shading) {
  ObjReader reader(bytes, name, shading);
  Result<Mesh> mesh = reader.read();
  if (!mesh) return mesh.error();
  Model model;
  auto source = std::make_unique<ObjSource>();
  reader.move_materials_to(model, *source);
  model.mesh = *std::move(mesh);
  reader.move_normals_to(model);
  reader.move_colors_to(model);
  model.format = FileFormat::obj;
  source->folder = base;
  model.side_files = source->side_files();
  source->bytes = std::move(bytes);
  model.source = std::move(source);
  return model;
}

}  // namespace wrapatlas
