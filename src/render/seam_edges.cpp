// The seams of an atlas on its model.
#include <algorithm>

#include "mesh/edge_groups.h"
#include "mesh/same_uv.h"
#include "wrapatlas/view.h"

namespace wrapatlas {
namespace {

class SeamFinder {
 public:
  SeamFinder(const Mesh& mesh, std::span<const std::uint32_t> face_chart)
      : mesh_(mesh), face_chart_(face_chart), welded_(weld_corners(mesh)) {
    corner_face_.reserve(mesh.corner_count());
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
      corner_face_.resize(mesh.face_begin[face + 1], face);
    }
  }

  std::vector<SeamEdge> find() {
    std::vector<EdgeUse> uses;
    uses.reserve(mesh_.corner_count());
    for (std::uint32_t c = 0; c < mesh_.corner_count(); ++c) {
      const std::uint32_t a = welded_.of_corner[c], b = welded_.of_corner[next(c)];
      if (a != b) uses.push_back({std::min(a, b), std::max(a, b), c, b < a});  // c: as a face
    }
    gather_edges(uses, welded_.count);
    std::vector<SeamEdge> seams;
    for_each_edge(std::span<const EdgeUse>(uses), [&](std::span<const EdgeUse> edge) {
      const bool is_seam = std::any_of(edge.begin() + 1, edge.end(), [&](const EdgeUse& use) {
        return is_cut_between(edge.front(), use);
      });
      const std::uint32_t c = edge.front().face;
      if (is_seam) seams.push_back({position(c), position(next(c))});
    });
    return seams;
  }

 private:
  [[nodiscard]] std::uint32_t next(std::uint32_t corner) const {
    const std::uint32_t face = corner_face_[corner];
    return corner + 1 < mesh_.face_begin[face + 1] ? corner + 1 : mesh_.face_begin[face];
  }

  [[nodiscard]] bool is_cut_between(const EdgeUse& a, const EdgeUse& b) const {
    if (face_chart_[corner_face_[a.face]] != face_chart_[corner_face_[b.face]]) return true;
    const std::uint32_t a_end = next(a.face), b_end = next(b.face);
    const bool same_way = a.reversed == b.reversed;
    return !same_uv(mesh_, a.face, same_way ? b.face : b_end) ||
           !same_uv(mesh_, a_end, same_way ? b_end : b.face);
  }

  [[nodiscard]] const Vec3& position(std::uint32_t corner) const {
    return mesh_.positions[mesh_.corner_position[corner]];
  }

  const Mesh& mesh_;
  std::span<const std::uint32_t> face_chart_;
  WeldedCorners welded_;
  std::vector<std::uint32_t> corner_face_;
};

}  // namespace

std::vector<SeamEdge> seam_edges(const Mesh& mesh, std::span<const std::uint32_t> face_chart) {
  return SeamFinder(mesh, face_chart).find();
}

}  // namespace wrapatlas
