#include "io/gltf_scene.h"

#include <array>
#include <cmath>
#include <utility>

#include "io/number.h"
#include "mesh/polygon_plane.h"

namespace wrapatlas {
namespace {

/// p -> columns * p + offset
struct NodePlace {
  std::array<Vec3, 3> columns{Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Vec3 offset;

  [[nodiscard]] Vec3 turned(const Vec3& v) const {
    return v.x * columns[0] + v.y * columns[1] + v.z * columns[2];
  }
  [[nodiscard]] Vec3 point(const Vec3& p) const { return turned(p) + offset; }
  /// Normals go by the cofactors: as the areas that they are perpendicular to.
  [[nodiscard]] Vec3 normal(const Vec3& n) const {
    const auto& [a, b, c] = columns;
    return n.x * cross(b, c) + n.y * cross(c, a) + n.z * cross(a, b);
  }
  [[nodiscard]] bool mirrors() const { return dot(columns[0], cross(columns[1], columns[2])) < 0; }
  [[nodiscard]] NodePlace after(const NodePlace& outer) const {
    NodePlace both;
    for (std::size_t i = 0; i < 3; ++i) both.columns[i] = outer.turned(columns[i]);
    both.offset = outer.point(offset);
    return both;
  }
};

/// The numbers of a member, or those given if it is not there or not of as many.
template <std::size_t kCount>
std::array<double, kCount> numbers(const Json& node, const char* key,
                                   const std::array<double, kCount>& otherwise) {
  const Json& list = array_member(node, key);
  if (list.size() != kCount) return otherwise;
  std::array<double, kCount> values{};
  for (std::size_t i = 0; i < kCount; ++i) {
    if (!list[i].is_number()) return otherwise;
    values[i] = list[i].template get<double>();
    if (!(std::abs(values[i]) < kCoordinateLimit)) return otherwise;
  }
  return values;
}

NodePlace placement_of(const Json& node) {
  NodePlace at;
  if (node.contains("matrix")) {
    const auto m = numbers<16>(node, "matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
    at.columns = {Vec3{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}};
    at.offset = {m[12], m[13], m[14]};
    return at;
  }
  const auto t = numbers<3>(node, "translation", {0, 0, 0});
  const auto [x, y, z, w] = numbers<4>(node, "rotation", {0, 0, 0, 1});
  const auto s = numbers<3>(node, "scale", {1, 1, 1});
  at.columns = {s[0] * Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
                s[1] * Vec3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
                s[2] * Vec3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)}};
  at.offset = {t[0], t[1], t[2]};
  return at;
}

struct Instance {
  std::uint64_t mesh;
  NodePlace at;
};

class Scene {
 public:
  explicit Scene(const GltfFile& file) : file_(file), nodes_(array_member(file.json, "nodes")) {}

  Result<std::vector<Instance>> read() {
    const Json& scenes = array_member(file_.json, "scenes");
    const auto chosen = integer_member(file_.json, "scene", 0);
    std::vector<bool> is_child(nodes_.size());
    if (chosen && *chosen < scenes.size()) {
      roots_ = children(scenes[*chosen], "nodes");
    } else {
      for (const Json& node : nodes_) {
        for (const std::uint64_t child : children(node, "children")) is_child[child] = true;
      }
      for (std::uint64_t i = 0; i < nodes_.size(); ++i) {
        if (!is_child[i]) roots_.push_back(i);
      }
    }
    // Depth first, in the order of the file; a tree visits no node twice.
    std::vector<std::pair<std::uint64_t, NodePlace>> open;
    for (auto root = roots_.rbegin(); root != roots_.rend(); ++root) open.push_back({*root, {}});
    std::size_t visited = 0;
    while (!open.empty()) {
      const auto [number, outer] = open.back();
      open.pop_back();
      if (++visited > nodes_.size()) {
        return file_.error("nodes", "they are no tree", "export the model again");
      }
      const Json& node = nodes_[number];
      const NodePlace at = placement_of(node).after(outer);
      const auto mesh = integer_member(node, "mesh", kNone);
      const bool skinned = node.contains("skin");
      if (mesh && *mesh != kNone) instances_.push_back({*mesh, skinned ? NodePlace{} : at});
      const std::vector<std::uint64_t> inner = children(node, "children");
      for (auto child = inner.rbegin(); child != inner.rend(); ++child) {
        open.push_back({*child, at});
      }
    }
    return std::move(instances_);
  }

 private:
  [[nodiscard]] std::vector<std::uint64_t> children(const Json& of, const char* key) const {
    std::vector<std::uint64_t> numbers;
    for (const Json& entry : array_member(of, key)) {
      const auto number = as_integer(entry);
      if (number && *number < nodes_.size()) numbers.push_back(*number);
    }
    return numbers;
  }

  const GltfFile& file_;
  const Json& nodes_;
  std::vector<std::uint64_t> roots_;
  std::vector<Instance> instances_;
};

/// The faces of a primitive as an instance shows them, behind those that there are.
void append(const Model& from, const GltfPrimitive& primitive, const NodePlace& at,
            std::uint32_t object, Model& to) {
  const Mesh& source = from.mesh;
  Mesh& mesh = to.mesh;
  const auto base = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t v = 0; v < primitive.vertex_count; ++v) {
    mesh.positions.push_back(at.point(source.positions[primitive.first_position + v]));
  }
  const std::array<std::uint32_t, 3> order =
      at.mirrors() ? std::array<std::uint32_t, 3>{0, 2, 1} : std::array<std::uint32_t, 3>{0, 1, 2};
  for (std::uint32_t f = 0; f < primitive.face_count; ++f) {
    const std::uint32_t face = primitive.first_face + f, first = source.face_begin[face];
    for (const std::uint32_t offset : order) {
      const std::uint32_t c = first + offset;
      mesh.corner_position.push_back(base + source.corner_position[c] - primitive.first_position);
      mesh.corner_texcoord.push_back(source.corner_texcoord[c]);
      if (!from.corner_normal.empty()) {
        const Vec3& n = from.corner_normal[c];
        to.corner_normal.push_back(unit((at.mirrors() ? -1.0 : 1.0) * at.normal(n)));
      }
      if (!from.corner_tangent.empty()) {
        const CornerTangent& own = from.corner_tangent[c];
        const float sign = at.mirrors() ? -own.sign : own.sign;
        to.corner_tangent.push_back({unit(at.turned(own.direction)), sign});
      }
      if (!from.corner_color.empty()) to.corner_color.push_back(from.corner_color[c]);
    }
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
    mesh.face_object.push_back(object);
    if (!from.face_material.empty()) to.face_material.push_back(from.face_material[face]);
  }
}

}  // namespace

Status place_in_scene(const GltfContents& contents, Model& model) {
  const auto instances = Scene(contents.file).read();
  if (!instances) return instances.error();
  Model placed;
  std::uint32_t object = 0;
  for (const Instance& instance : *instances) {
    for (const GltfPrimitive& primitive : contents.primitives) {
      if (primitive.mesh != instance.mesh) continue;
      if (placed.mesh.corner_count() + 3 * std::size_t{primitive.face_count} > kNone / 2 ||
          placed.mesh.positions.size() + primitive.vertex_count > kNone / 2) {
        return contents.file.error("nodes", "together they have too many faces",
                                   "export the model in parts");
      }
      append(model, primitive, instance.at, object, placed);
    }
    ++object;
  }
  if (placed.mesh.face_count() == 0) return Done{};
  placed.mesh.texcoords = std::move(model.mesh.texcoords);
  model.mesh = std::move(placed.mesh);
  model.face_material = std::move(placed.face_material);
  model.corner_normal = std::move(placed.corner_normal);
  model.corner_tangent = std::move(placed.corner_tangent);
  model.corner_color = std::move(placed.corner_color);
  return Done{};
}

}  // namespace wrapatlas
