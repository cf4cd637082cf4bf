// The seams of an atlas on its model.
#include <algorithm>

#include "mesh/edge_groups.h"
#include "wrapatlas/view.h"

namespace wrapatlas {
namespace {

/// A use of an edge, with the UVs at its lower and its higher end.
struct UvUse {
  std::uint32_t face = 0;
  Vec2 low, high;
  bool has_uvs = false;

  [[nodiscard]] bool same_uvs(const UvUse& other) const {
    if (!has_uvs || !other.has_uvs) return has_uvs == other.has_uvs;
    return low == other.low && high == other.high;
  }
};

class SeamFinder {
 public:
  SeamFinder(const Mesh& mesh, std::span<const std::uint32_t> face_chart)
      : mesh_(mesh), face_chart_(face_chart), welded_(weld_corners(mesh)) {}

  std::vector<SeamEdge> find() {
    std::vector<EdgeUse> uses;
    uses.reserve(mesh_.corner_count());
    for (std::uint32_t face = 0; face < mesh_.face_count(); ++face) {
      for (std::uint32_t c = mesh_.face_begin[face]; c < mesh_.face_begin[face + 1]; ++c) {
        const std::uint32_t a = welded_.of_corner[c], b = welded_.of_corner[next(face, c)];
        if (a != b) uses.push_back({std::min(a, b), std::max(a, b), face, b < a});
      }
    }
    gather_edges(uses, welded_.count);
    std::vector<SeamEdge> seams;
    for_each_edge(std::span<const EdgeUse>(uses), [&](std::span<const EdgeUse> edge) {
      const UvUse first = uvs_of(edge.front());
      const bool is_seam = std::any_of(edge.begin() + 1, edge.end(), [&](const EdgeUse& use) {
        return face_chart_[use.face] != face_chart_[first.face] || !uvs_of(use).same_uvs(first);
      });
      if (!is_seam) return;
      const std::uint32_t c = corner_of(edge.front());
      seams.push_back({position(c), position(next(edge.front().face, c))});
    });
    return seams;
  }

 private:
  [[nodiscard]] std::uint32_t next(std::uint32_t face, std::uint32_t corner) const {
    return corner + 1 < mesh_.face_begin[face + 1] ? corner + 1 : mesh_.face_begin[face];
  }

  /// Where the face begins the edge. (A face that uses an edge twice: the first time.)
  [[nodiscard]] std::uint32_t corner_of(const EdgeUse& use) const {
    const std::uint32_t from = use.reversed ? use.high : use.low;
    const std::uint32_t to = use.reversed ? use.low : use.high;
    std::uint32_t c = mesh_.face_begin[use.face];
    while (welded_.of_corner[c] != from || welded_.of_corner[next(use.face, c)] != to) ++c;
    return c;
  }

  [[nodiscard]] UvUse uvs_of(const EdgeUse& use) const {
    const std::uint32_t from = corner_of(use), to = next(use.face, from);
    const std::uint32_t low = mesh_.corner_texcoord[use.reversed ? to : from];
    const std::uint32_t high = mesh_.corner_texcoord[use.reversed ? from : to];
    if (low == kNone || high == kNone) return {use.face, {}, {}, false};
    return {use.face, mesh_.texcoords[low], mesh_.texcoords[high], true};
  }

  [[nodiscard]] const Vec3& position(std::uint32_t corner) const {
    return mesh_.positions[mesh_.corner_position[corner]];
  }

  const Mesh& mesh_;
  std::span<const std::uint32_t> face_chart_;
  WeldedCorners welded_;
};

}  // namespace

std::vector<SeamEdge> seam_edges(const Mesh& mesh, std::span<const std::uint32_t> face_chart) {
  return SeamFinder(mesh, face_chart).find();
}

}  // namespace wrapatlas
