#include "io/gltf_primitives.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "io/face_labels.h"

namespace wrapatlas {
namespace {

constexpr std::uint64_t kTriangles = 4, kFan = 6;  // 5: strip

class Reader {
 public:
  Reader(GltfContents& contents, const LoadOptions& options, Mesh& mesh)
      : contents_(contents),
        options_(options),
        set_before_(fmt::format("TEXCOORD_{}", options.texcoord_set - 1)),
        file_(contents.file),
        mesh_(mesh),
        most_(std::max<std::uint64_t>(1U << 24U, 16 * contents.file.byte_count)),
        position_base_(array_member(file_.json, "accessors").size(), kNone),
        texcoord_base_(position_base_) {
    most_ = std::min<std::uint64_t>(most_, kNone - 1);
  }

  Status read_all() {
    const Json& meshes = array_member(file_.json, "meshes");
    std::uint32_t objects = 0;
    for (std::uint32_t m = 0; m < meshes.size(); ++m) {
      const std::size_t first_face = mesh_.face_count();
      const Json& primitives = array_member(meshes[m], "primitives");
      for (std::uint32_t p = 0; p < primitives.size(); ++p) {
        place_ = fmt::format("mesh {}, primitive {}", m, p);
        const Json& json = primitives[p];
        if (!json.is_object()) return file_.error(place_, "it is not an object");
        GltfPrimitive primitive;
        primitive.mesh = m;
        primitive.primitive = p;
        if (Status read = read_one(json, primitive); !read) return read;
      }
      assign_object(mesh_, first_face, objects);
      if (mesh_.face_count() > first_face) ++objects;
    }
    return Done{};
  }

  /// The UV set that was asked for is in some primitive, or there is no other that could be meant.
  [[nodiscard]] Status check_texcoord_name() const {
    const bool first = contents_.texcoord_name == "TEXCOORD_0";
    if (texcoord_names_.count(contents_.texcoord_name) != 0) return Done{};
    if (first && (texcoord_names_.empty() || options_.may_add_set)) return Done{};
    if (options_.may_add_set && texcoord_names_.count(set_before_) != 0) {
      if (without_set_before_ == 0) return Done{};
      return file_.error("",
                         fmt::format("{} would follow on {}, which {} of its primitives lack",
                                     contents_.texcoord_name, set_before_, without_set_before_),
                         "leave out --texcoord, or give those faces UVs first");
    }
    if (texcoord_names_.empty()) {
      return file_.error("",
                         fmt::format("it has no {}, nor any other UVs", contents_.texcoord_name),
                         "unwrap it first");
    }
    return file_.error("", fmt::format("it has no UV set {}", contents_.texcoord_name),
                       fmt::format("it has {}: choose one by --texcoord and its number",
                                   fmt::join(texcoord_names_, ", ")));
  }

  void remark(std::vector<std::string>& remarks) const {
    const auto add = [&](std::size_t count, std::string_view what) {
      if (count != 0) remarks.push_back(fmt::format("{} {}", count, what));
    };
    add(not_triangles_, "primitives of points or lines are left as they are");
    add(without_position_, "primitives without POSITION are left as they are");
    if (without_texcoords_ != 0 && !options_.may_add_set) {
      remarks.push_back(
          fmt::format("{} faces in {} primitives have no {}: they are left as they are",
                      faces_without_texcoords_, without_texcoords_, contents_.texcoord_name));
    }
    add(ragged_, "primitives end in the middle of a triangle: the rest is ignored");
    add(draco_, "primitives have a Draco copy of their data: it is dropped where UVs change");
    add(moving_texcoords_,
        "primitives have morph targets that move the UVs: these stay as they are");
  }

 private:
  Status read_one(const Json& json, GltfPrimitive& primitive) {
    const auto mode = integer_member(json, "mode", kTriangles);
    if (!mode || *mode > kFan) return file_.error(place_, "its mode is unknown");
    if (*mode < kTriangles) {
      ++not_triangles_;
      return Done{};
    }
    const Json* attributes = find_member(json, "attributes");
    const Json* position = attributes == nullptr ? nullptr : find_member(*attributes, "POSITION");
    if (position == nullptr) {
      ++without_position_;
      return Done{};
    }
    const Json* extensions = find_member(json, "extensions");
    if (extensions != nullptr &&
        find_member(*extensions, "KHR_draco_mesh_compression") != nullptr) {
      ++draco_;
    }
    if (Status opened = open_vertices(*attributes, *position, primitive); !opened) return opened;
    if (Status checked = check_targets(json, primitive.vertex_count); !checked) return checked;
    if (Status read = read_faces(json, *mode, primitive); !read) return read;
    contents_.primitives.push_back(primitive);
    return Done{};
  }

  Result<GltfAccessor> open(const Json& index, std::string_view attribute) const {
    const auto number = as_integer(index);
    if (!number)
      return file_.error(place_, fmt::format("{} is not the index of an accessor", attribute));
    return open_accessor(file_, *number);
  }

  Status wrong_count(const GltfAccessor& accessor, std::string_view attribute,
                     std::size_t wanted) const {
    return file_.error(accessor_place(accessor.index),
                       fmt::format("it has {} elements as {} of a primitive of {} vertices",
                                   accessor.count, attribute, wanted));
  }

  Status open_vertices(const Json& attributes, const Json& position, GltfPrimitive& primitive) {
    const Result<GltfAccessor> points = open(position, "POSITION");
    if (!points) return points.error();
    if (points->components != 3 || points->component == GltfComponent::u32) {
      return file_.error(accessor_place(points->index),
                         "it is a POSITION but not a VEC3 of numbers");
    }
    if (points->count >= kNone) return file_.error(place_, "it has too many vertices");
    primitive.vertex_count = static_cast<std::uint32_t>(points->count);
    std::optional<GltfAccessor> texcoords;
    for (const auto& [name, index] : attributes.items()) {
      const Result<GltfAccessor> accessor = open(index, name);
      if (!accessor) return accessor.error();
      if (accessor->count != points->count) return wrong_count(*accessor, name, points->count);
      if (name == contents_.texcoord_name) texcoords = *accessor;
      if (name.starts_with("TEXCOORD_")) texcoord_names_.insert(name);
    }
    if (attributes.find(set_before_) == attributes.end()) ++without_set_before_;
    if (Status added = add_points(*points, mesh_.positions, position_base_); !added) return added;
    primitive.first_position = position_base_[points->index];
    first_texcoord_ = kNone;
    if (!texcoords) return Done{};
    if (texcoords->components != 2 || texcoords->component == GltfComponent::u32) {
      return file_.error(
          accessor_place(texcoords->index),
          fmt::format("it is a {} but not a VEC2 of numbers", contents_.texcoord_name));
    }
    if (Status added = add_points(*texcoords, mesh_.texcoords, texcoord_base_); !added)
      return added;
    first_texcoord_ = texcoord_base_[texcoords->index];
    primitive.has_texcoords = true;
    return Done{};
  }

  /// Primitives often share accessors: each is read once.
  template <typename Point>
  Status add_points(const GltfAccessor& accessor, std::vector<Point>& points,
                    std::vector<std::uint32_t>& base) const {
    if (base[accessor.index] != kNone) return Done{};
    if (points.size() + accessor.count > most_) return too_much();
    base[accessor.index] = static_cast<std::uint32_t>(points.size());
    return read_points(file_, accessor, points);
  }

  Status check_targets(const Json& json, std::size_t vertex_count) {
    const Json& targets = array_member(json, "targets");
    bool moves_texcoords = false;
    for (const Json& target : targets) {
      if (!target.is_object()) return file_.error(place_, "a morph target is not an object");
      for (const auto& [name, index] : target.items()) {
        const Result<GltfAccessor> accessor = open(index, name);
        if (!accessor) return accessor.error();
        if (accessor->count != vertex_count) return wrong_count(*accessor, name, vertex_count);
        moves_texcoords = moves_texcoords || name == contents_.texcoord_name;
      }
    }
    if (moves_texcoords) ++moving_texcoords_;
    return Done{};
  }

  Status read_faces(const Json& json, std::uint64_t mode, GltfPrimitive& primitive) {
    std::optional<GltfAccessor> indices;
    if (const Json* index = find_member(json, "indices")) {
      const Result<GltfAccessor> accessor = open(*index, "indices");
      if (!accessor) return accessor.error();
      indices = *accessor;
    }
    const std::size_t count = indices ? indices->count : primitive.vertex_count;
    const std::size_t triangles = mode == kTriangles ? count / 3 : count < 3 ? 0 : count - 2;
    if (mesh_.corner_count() + 3 * triangles > most_) return too_much();
    if (mode == kTriangles ? count % 3 != 0 : count < 3) ++ragged_;

    primitive.first_face = static_cast<std::uint32_t>(mesh_.face_count());
    std::vector<std::uint32_t>& corners = mesh_.corner_position;
    const std::size_t first_corner = corners.size();
    if (mode == kTriangles) {
      if (Status read = read_positions(indices, primitive, corners); !read) return read;
      corners.resize(first_corner + 3 * triangles);
    } else {
      std::vector<std::uint32_t> strip;
      if (Status read = read_positions(indices, primitive, strip); !read) return read;
      for (std::size_t i = 0; i < triangles; ++i) {
        const std::uint32_t a = strip[mode == kFan ? i + 1 : i];
        const std::uint32_t b = strip[mode == kFan ? i + 2 : i + 1 + i % 2];
        const std::uint32_t c = strip[mode == kFan ? 0 : i + 2 - i % 2];
        // Strips jump by triangles without area.
        if (a != b && b != c && c != a) corners.insert(corners.end(), {a, b, c});
      }
    }
    add_faces(primitive, first_corner);
    if (!primitive.has_texcoords) {
      ++without_texcoords_;
      faces_without_texcoords_ += primitive.face_count;
    }
    return Done{};
  }

  /// Appends the position of each index, or of each vertex if there are no indices.
  Status read_positions(const std::optional<GltfAccessor>& indices, const GltfPrimitive& primitive,
                        std::vector<std::uint32_t>& positions) const {
    if (indices) {
      return read_indices(file_, *indices, primitive.vertex_count, primitive.first_position,
                          positions);
    }
    positions.resize(positions.size() + primitive.vertex_count);
    std::iota(positions.end() - primitive.vertex_count, positions.end(), primitive.first_position);
    return Done{};
  }

  /// Makes triangles of the corners from `first_corner` on, whose positions are known.
  void add_faces(GltfPrimitive& primitive, std::size_t first_corner) {
    const std::size_t corners = mesh_.corner_position.size();
    mesh_.corner_texcoord.resize(corners, kNone);
    if (primitive.has_texcoords) {
      const std::uint32_t shift = first_texcoord_ - primitive.first_position;  // may wrap around
      for (std::size_t c = first_corner; c < corners; ++c) {
        mesh_.corner_texcoord[c] = mesh_.corner_position[c] + shift;
      }
    }
    const std::size_t first_face = mesh_.face_count();
    primitive.face_count = static_cast<std::uint32_t>((corners - first_corner) / 3);
    mesh_.face_begin.resize(first_face + primitive.face_count + 1);
    for (std::size_t f = first_face; f < mesh_.face_count(); ++f) {
      mesh_.face_begin[f + 1] = static_cast<std::uint32_t>(3 * (f + 1));
    }
  }

  Status too_much() const {
    return file_.error(place_, "the primitives repeat the same data too often",
                       "instance meshes by nodes instead");
  }

  GltfContents& contents_;
  const LoadOptions& options_;
  std::string set_before_;  ///< the UV set that one to be added follows
  const GltfFile& file_;
  Mesh& mesh_;
  std::uint64_t most_;  ///< small files may not describe huge meshes
  std::vector<std::uint32_t> position_base_, texcoord_base_;  ///< per accessor
  std::uint32_t first_texcoord_ = kNone;
  std::string place_;
  std::set<std::string> texcoord_names_;  ///< of all UV sets that there are
  std::size_t without_set_before_ = 0;    ///< primitives
  std::size_t not_triangles_ = 0, without_position_ = 0, without_texcoords_ = 0;
  std::size_t faces_without_texcoords_ = 0, ragged_ = 0, draco_ = 0, moving_texcoords_ = 0;
};

}  // namespace

Status read_primitives(GltfContents& contents, const LoadOptions& options, Mesh& mesh,
                       std::vector<std::string>& remarks) {
  Reader reader(contents, options, mesh);
  if (Status read = reader.read_all(); !read) return read;
  if (Status found = reader.check_texcoord_name(); !found) return found;
  reader.remark(remarks);
  return Done{};
}

}  // namespace wrapatlas
