#include "simplify/triangulated.h"

#include "mesh/polygon_plane.h"

namespace wrapatlas {
namespace {

class Cutter {
 public:
  explicit Cutter(const Mesh& source) : source_(source) {
    made_.mesh.positions = source.positions;
    made_.mesh.texcoords = source.texcoords;
    const std::size_t faces = source.corner_count() - 2 * source.face_count();
    made_.source.reserve(faces);
    made_.mesh.face_begin.reserve(faces + 1);
    made_.mesh.corner_position.reserve(3 * faces);
    made_.mesh.corner_texcoord.reserve(3 * faces);
  }

  Triangulated cut() {
    for (std::uint32_t face = 0; face < source_.face_count(); ++face) cut_face(face);
    return std::move(made_);
  }

 private:
  void cut_face(std::uint32_t face) {
    const std::uint32_t begin = source_.face_begin[face];
    cuts_.clear();
    flat_.resize(source_.face_size(face));
    if (flat_.size() > 3) {
      const Plane plane(polygon_normal(source_, face));
      for (std::uint32_t i = 0; i < flat_.size(); ++i) {
        flat_[i] = plane.project(source_.positions[source_.corner_position[begin + i]]);
      }
    }
    triangulate_polygon(flat_, cuts_);
    bool has_uvs = true;
    for (std::uint32_t i = 0; i < flat_.size(); ++i) {
      has_uvs = has_uvs && source_.corner_texcoord[begin + i] != kNone;
    }
    for (const auto& [i, j, k] : cuts_) add(face, {begin + i, begin + j, begin + k}, has_uvs);
  }

  void add(std::uint32_t face, const std::array<std::uint32_t, 3>& corners, bool has_uvs) {
    const auto point = [&](std::size_t i) -> const Vec3& {
      return source_.positions[source_.corner_position[corners[i]]];
    };
    if (point(0) == point(1) || point(1) == point(2) || point(2) == point(0)) {
      ++made_.dropped;
      return;
    }
    Mesh& mesh = made_.mesh;
    for (const std::uint32_t c : corners) {
      mesh.corner_position.push_back(source_.corner_position[c]);
      mesh.corner_texcoord.push_back(has_uvs ? source_.corner_texcoord[c] : kNone);
    }
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
    if (!source_.face_object.empty()) mesh.face_object.push_back(source_.face_object[face]);
    made_.source.push_back(face);
  }

  const Mesh& source_;
  Triangulated made_;
  std::vector<Vec2> flat_;
  std::vector<std::array<std::uint32_t, 3>> cuts_;
};

}  // namespace

Triangulated triangulated(const Mesh& mesh) { return Cutter(mesh).cut(); }

}  // namespace wrapatlas
