// PLY (Turk's polygon file format): the elements `vertex` and `face`. Everything else stays in the
// bytes, which are kept to write the file back.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "io/file.h"
#include "io/formats.h"
#include "io/number.h"
#include "io/ply_write.h"
#include "mesh/polygon_plane.h"
#include "wrapatlas/texture.h"

namespace wrapatlas {
namespace {

struct PlySource final : Model::Source {
  Status save(const std::filesystem::path& path, const Mesh& mesh,
              const AtlasMesh& atlas) const override {
    Result<PlyHeader> header = read_ply_header(bytes, path.string());
    if (!header) return header.error();
    Result<std::string> out = rewrite_ply(bytes, *header, roles, mesh, atlas);
    if (!out) return out.error();
    return write_file(path, *out);
  }
  std::string bytes;
  PlyRoles roles;
};

int find_scalar(const PlyElement& element, std::string_view name, bool needs_float) {
  const int i = element.find(name);
  if (i < 0 || element.properties[i].is_list) return -1;
  return needs_float && !ply_is_float(element.properties[i].type) ? -1 : i;
}

int find_list(const PlyElement& element, std::string_view name) {
  const int i = element.find(name);
  return i >= 0 && element.properties[i].is_list ? i : -1;
}

PlyRoles find_roles(const PlyHeader& header, bool shading) {
  PlyRoles roles;
  roles.vertex = header.find("vertex");
  roles.face = header.find("face");
  if (roles.vertex >= 0) {
    const PlyElement& vertex = header.elements[roles.vertex];
    roles.x = find_scalar(vertex, "x", false);
    roles.y = find_scalar(vertex, "y", false);
    roles.z = find_scalar(vertex, "z", false);
    constexpr std::array<std::array<std::string_view, 2>, 3> kNames{
        {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}}};
    for (const auto& [u, v] : kNames) {
      roles.u = find_scalar(vertex, u, true);
      roles.v = find_scalar(vertex, v, true);
      if (roles.u >= 0 && roles.v >= 0) break;
      roles.u = roles.v = -1;
    }
    const auto find_three = [&](std::array<int*, 3> roles_of,
                                std::array<std::string_view, 3> names) {
      bool all = shading;
      for (std::size_t i = 0; i < 3 && all; ++i) {
        *roles_of[i] = find_scalar(vertex, names[i], false);
        all = *roles_of[i] >= 0;
      }
      for (std::size_t i = 0; i < 3 && !all; ++i) *roles_of[i] = -1;
    };
    find_three({&roles.red, &roles.green, &roles.blue}, {"red", "green", "blue"});
    find_three({&roles.nx, &roles.ny, &roles.nz}, {"nx", "ny", "nz"});
  }
  if (roles.face >= 0) {
    const PlyElement& face = header.elements[roles.face];
    roles.indices = find_list(face, "vertex_indices");
    if (roles.indices < 0) roles.indices = find_list(face, "vertex_index");
    roles.texcoord = find_list(face, "texcoord");
    if (roles.texcoord >= 0 && !ply_is_float(face.properties[roles.texcoord].type)) {
      roles.texcoord = -1;
    }
  }
  return roles;
}

class PlyReader {
 public:
  PlyReader(std::string_view bytes, std::string_view name, const PlyHeader& header,
            const PlyRoles& roles)
      : name_(name), header_(header), roles_(roles), cursor_(bytes, header) {}

  Result<Mesh> read() {
    for (int i = 0; i < static_cast<int>(header_.elements.size()); ++i) {
      const PlyElement& element = header_.elements[i];
      element_ = &element;
      record_ = 0;
      const bool fine = i == roles_.vertex ? read_vertices(element)
                        : i == roles_.face ? read_faces(element)
                                           : cursor_.skip(element) || cut_short();
      if (!fine) return error_here();
    }
    return std::move(mesh_);
  }

  /// Per corner; what is no vector is none.
  [[nodiscard]] std::vector<Vec3> normals(const Mesh& mesh) const {
    std::vector<Vec3> result;
    if (roles_.nx < 0) return result;
    for (const std::uint32_t vertex : mesh.corner_position) {
      const Vec3 n = normals_[vertex];
      const bool usable = std::abs(n.x) + std::abs(n.y) + std::abs(n.z) < kCoordinateLimit;
      result.push_back(usable ? unit(n) : Vec3{});
    }
    return result;
  }

  /// Linear light, per corner; what is no number is black.
  [[nodiscard]] std::vector<std::array<float, 3>> colors(const Mesh& mesh) const {
    std::vector<std::array<float, 3>> result;
    if (roles_.red < 0) return result;
    const PlyElement& vertex = header_.elements[roles_.vertex];
    std::array<double, 3> most{1, 1, 1};
    for (std::size_t c = 0; c < 3; ++c) {
      const int property = std::array<int, 3>{roles_.red, roles_.green, roles_.blue}[c];
      const PlyType type = vertex.properties[property].type;
      if (!ply_is_float(type)) most[c] = ply_max(type);
    }
    result.reserve(mesh.corner_count());
    for (const std::uint32_t i : mesh.corner_position) {
      auto& linear = result.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) {
        const double value = colors_[i][c] / most[c];
        linear[c] = srgb_to_linear(static_cast<float>(value > 0 ? std::min(value, 1.0) : 0));
      }
    }
    return result;
  }

 private:
  bool fail(std::string what) {
    what_ = std::move(what);
    return false;
  }
  bool cut_short() { return fail("the file ends too early, or a word is no number"); }

  Error error_here() const {
    std::string where =
        header_.encoding == PlyEncoding::text
            ? fmt::format("{}:{}", name_, cursor_.line())
            : fmt::format("{}: {} {}", name_, element_->name.substr(0, 40), record_);
    return {ErrorKind::input, std::move(where), what_, "export the mesh again"};
  }

  bool read_vertices(const PlyElement& vertex) {
    if (vertex.count >= kNone) return fail("there are too many vertices");
    mesh_.positions.resize(vertex.count);
    if (roles_.uvs_on_vertices()) mesh_.texcoords.resize(vertex.count);
    if (roles_.red >= 0) colors_.resize(vertex.count);
    if (roles_.nx >= 0) normals_.resize(vertex.count);
    std::string_view raw;
    for (record_ = 0; record_ < vertex.count; ++record_) {
      for (int i = 0; i < static_cast<int>(vertex.properties.size()); ++i) {
        double* target = target_of(i);
        if (target == nullptr) {
          if (!cursor_.skip(vertex.properties[i], raw)) return cut_short();
        } else {
          if (!cursor_.read(vertex.properties[i].type, *target)) return cut_short();
          if (!is_shading(i) && !(std::abs(*target) < kCoordinateLimit)) {
            return fail("a coordinate is not a usable number");
          }
        }
      }
    }
    return true;
  }
  [[nodiscard]] bool is_shading(int property) const {
    return property == roles_.red || property == roles_.green || property == roles_.blue ||
           property == roles_.nx || property == roles_.ny || property == roles_.nz;
  }
  double* target_of(int property) {
    if (property == roles_.nx) return &normals_[record_].x;
    if (property == roles_.ny) return &normals_[record_].y;
    if (property == roles_.nz) return &normals_[record_].z;
    if (property == roles_.red) return &colors_[record_][0];
    if (property == roles_.green) return &colors_[record_][1];
    if (property == roles_.blue) return &colors_[record_][2];
    if (property == roles_.x) return &mesh_.positions[record_].x;
    if (property == roles_.y) return &mesh_.positions[record_].y;
    if (property == roles_.z) return &mesh_.positions[record_].z;
    if (!roles_.uvs_on_vertices()) return nullptr;
    if (property == roles_.u) return &mesh_.texcoords[record_].x;
    if (property == roles_.v) return &mesh_.texcoords[record_].y;
    return nullptr;
  }

  bool read_faces(const PlyElement& face) {
    mesh_.face_begin.reserve(face.count + 1);
    std::string_view raw;
    for (record_ = 0; record_ < face.count; ++record_) {
      uvs_.clear();
      for (int i = 0; i < static_cast<int>(face.properties.size()); ++i) {
        const PlyProperty& property = face.properties[i];
        const bool fine = i == roles_.indices    ? read_indices(property)
                          : i == roles_.texcoord ? read_uvs(property)
                                                 : cursor_.skip(property, raw) || cut_short();
        if (!fine) return false;
      }
      if (!finish_face()) return false;
    }
    return true;
  }

  bool read_indices(const PlyProperty& property) {
    std::size_t length = 0;
    if (!cursor_.read_length(property, length)) return cut_short();
    if (length < 3) return fail(fmt::format("a face needs three corners and has {}", length));
    const std::uint64_t vertices = header_.elements[roles_.vertex].count;
    for (std::size_t k = 0; k < length; ++k) {
      double index = 0;
      if (!cursor_.read(property.type, index)) return cut_short();
      if (!(index >= 0) || index >= static_cast<double>(vertices) || index != std::floor(index)) {
        return fail(fmt::format("the face refers to vertex {} of {}", index, vertices));
      }
      mesh_.corner_position.push_back(static_cast<std::uint32_t>(index));
    }
    return true;
  }

  bool read_uvs(const PlyProperty& property) {
    std::size_t length = 0;
    if (!cursor_.read_length(property, length)) return cut_short();
    for (std::size_t k = 0; k < length; ++k) {
      double value = 0;
      if (!cursor_.read(property.type, value)) return cut_short();
      if (!(std::abs(value) < kCoordinateLimit)) return fail("a UV is not a usable number");
      uvs_.push_back(value);
    }
    return true;
  }

  bool finish_face() {
    const std::size_t begin = mesh_.face_begin.back(), end = mesh_.corner_position.size();
    if (end >= kNone) return fail("there are too many faces");
    mesh_.face_begin.push_back(static_cast<std::uint32_t>(end));
    if (roles_.uvs_on_vertices()) return true;
    if (!uvs_.empty() && uvs_.size() != 2 * (end - begin)) {
      return fail(fmt::format("the face has {} corners and {} numbers in 'texcoord'", end - begin,
                              uvs_.size()));
    }
    for (std::size_t k = begin; k < end; ++k) {
      const bool has_uv = !uvs_.empty();
      mesh_.corner_texcoord.push_back(has_uv ? static_cast<std::uint32_t>(mesh_.texcoords.size())
                                             : kNone);
      if (has_uv) mesh_.texcoords.push_back({uvs_[2 * (k - begin)], uvs_[2 * (k - begin) + 1]});
    }
    return true;
  }

  std::string_view name_;
  const PlyHeader& header_;
  const PlyRoles& roles_;
  PlyCursor cursor_;
  const PlyElement* element_ = nullptr;
  std::uint64_t record_ = 0;
  Mesh mesh_;
  std::vector<std::array<double, 3>> colors_;
  std::vector<Vec3> normals_;
  std::vector<double> uvs_;  // of the face at hand
  std::string what_;
};

}  // namespace

Result<Model> read_ply(std::string bytes, std::string_view name, bool shading) {
  auto source = std::make_unique<PlySource>();
  source->bytes = std::move(bytes);
  const Result<PlyHeader> header = read_ply_header(source->bytes, name);
  if (!header) return header.error();
  PlyRoles& roles = source->roles;
  roles = find_roles(*header, shading);
  if (roles.x < 0 || roles.y < 0 || roles.z < 0) {
    return Error{ErrorKind::input, std::string(name), "the header has no vertices with x, y and z",
                 "export the mesh again"};
  }
  if (roles.indices < 0) {
    return Error{ErrorKind::input, std::string(name),
                 "the header has no faces with a list vertex_indices",
                 "export the mesh again as polygons"};
  }
  PlyReader reader(source->bytes, name, *header, roles);
  Result<Mesh> mesh = reader.read();
  if (!mesh) return mesh.error();
  Model model;
  model.corner_color = reader.colors(*mesh);
  model.corner_normal = reader.normals(*mesh);
  model.format = FileFormat::ply;
  model.mesh = *std::move(mesh);
  if (roles.uvs_on_vertices()) model.mesh.corner_texcoord = model.mesh.corner_position;
  if (roles.texcoord >= 0 && roles.u >= 0) {
    model.remarks.emplace_back(
        "the UVs of the faces are used and those of the vertices left as "
        "they are");
  }
  model.source = std::move(source);
  return model;
}

}  // namespace wrapatlas
