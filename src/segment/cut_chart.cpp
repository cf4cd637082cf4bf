#include "segment/cut_chart.h"

#include <algorithm>
#include <queue>

#include "mesh/union_find.h"

namespace wrapatlas {
namespace {

class ChartCutter {
 public:
  ChartCutter(const Surface& surface, const Region& region, const FaceShapes& shapes,
              std::span<const std::uint32_t> seams)
      : surface_(surface), region_(region), shapes_(shapes), seams_(seams) {}

  CutChart build() {
    number_corners();
    find_twins();
    begin_loops();
    join_faces();
    close_border();
    number_points();
    return std::move(disc_);
  }

 private:
  void number_corners() {
    for (std::uint32_t i = 0; i < region_.size(); ++i) {
      const std::uint32_t face = region_.faces[i];
      const std::uint32_t size = surface_.face_begin[face + 1] - surface_.face_begin[face];
      disc_.corner_begin.push_back(disc_.corner_begin.back() + size);
      disc_.corner_face.insert(disc_.corner_face.end(), size, i);
    }
  }

  [[nodiscard]] std::uint32_t within(std::uint32_t face, std::uint32_t corner) const {
    return disc_.corner_begin[face] + corner - surface_.face_begin[region_.faces[face]];
  }

  void find_twins() {
    twin_.assign(disc_.corner_face.size(), kNone);
    for (std::uint32_t i = 0; i < region_.size(); ++i) {
      for (const Region::Arc arc : region_.arcs_of(i)) {
        if (std::binary_search(seams_.begin(), seams_.end(), arc.corner)) continue;
        twin_[within(i, arc.corner)] = within(arc.to, surface_.corner_twin[arc.corner]);
      }
    }
  }

  /// Each face is a disc with a border of its own.
  void begin_loops() {
    const std::size_t count = twin_.size();
    after_.resize(count);
    before_.resize(count);
    disc_.corner_twin.assign(count, kNone);
    for (std::uint32_t c = 0; c < count; ++c) {
      after_[c] = disc_.next(c);
      before_[after_[c]] = c;
    }
  }

  void link(std::uint32_t a, std::uint32_t b) {
    after_[a] = b;
    before_[b] = a;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    disc_.corner_twin[a] = b;
    disc_.corner_twin[b] = a;
  }

  void join_faces() {
    struct Step {
      double cost;
      std::uint32_t face, through;  // the corner it is entered by, of the face before it
      bool operator>(const Step& other) const {
        return cost != other.cost ? cost > other.cost : through > other.through;
      }
    };
    std::priority_queue<Step, std::vector<Step>, std::greater<>> steps;
    std::vector<bool> reached(region_.size(), false);
    steps.push({0, 0, kNone});
    while (!steps.empty()) {
      const Step step = steps.top();
      steps.pop();
      if (reached[step.face]) continue;
      reached[step.face] = true;
      if (step.through != kNone) {
        const std::uint32_t a = step.through, b = twin_[a];
        join(a, b);
        const std::uint32_t after_b = after_[b], before_b = before_[b];
        link(before_b, after_[a]);
        link(before_[a], after_b);
      }
      for (std::uint32_t c = disc_.corner_begin[step.face]; c < disc_.corner_begin[step.face + 1];
           ++c) {
        if (twin_[c] == kNone || reached[disc_.corner_face[twin_[c]]]) continue;
        const std::uint32_t to = disc_.corner_face[twin_[c]];
        const double way = length(shapes_.centroid[region_.faces[step.face]] -
                                  shapes_.centroid[region_.faces[to]]);
        steps.push({step.cost + way, to, c});
      }
    }
  }

  void close_border() {
    for (std::uint32_t c = 0; c < twin_.size(); ++c) {
      std::uint32_t a = c;
      while (disc_.corner_twin[a] == kNone && twin_[a] != kNone && after_[a] == twin_[a]) {
        const std::uint32_t b = twin_[a];
        if (after_[b] == a) {  // nothing else is left of the border
          disc_.is_closed = true;
          return;
        }
        join(a, b);
        const std::uint32_t before = before_[a];
        link(before, after_[b]);
        a = before;
      }
    }
  }

  void number_points() {
    const auto count = static_cast<std::uint32_t>(twin_.size());
    UnionFind fans(count);
    for (std::uint32_t c = 0; c < count; ++c) {
      const std::uint32_t t = disc_.corner_twin[c];
      if (t != kNone) fans.unite(c, disc_.next(t));
    }
    disc_.corner_point.resize(count);
    for (std::uint32_t c = 0; c < count; ++c) {
      const std::uint32_t root = fans.find(c);
      if (root != c) {
        disc_.corner_point[c] = disc_.corner_point[root];
        continue;
      }
      disc_.corner_point[c] = static_cast<std::uint32_t>(disc_.points.size());
      const std::uint32_t face = disc_.corner_face[c];
      const std::uint32_t corner =
          surface_.face_begin[region_.faces[face]] + c - disc_.corner_begin[face];
      disc_.points.push_back(surface_.points[surface_.corner_vertex[corner]]);
    }
    for (std::uint32_t i = 0; i < region_.size(); ++i) {
      const std::uint32_t face = region_.faces[i];
      for (std::uint32_t t = surface_.triangle_begin[face]; t < surface_.triangle_begin[face + 1];
           ++t) {
        const auto& [a, b, c] = surface_.triangles[t];
        disc_.triangles.push_back({disc_.corner_point[within(i, a)],
                                   disc_.corner_point[within(i, b)],
                                   disc_.corner_point[within(i, c)]});
        disc_.triangle_face.push_back(i);
      }
    }
  }

  const Surface& surface_;
  const Region& region_;
  const FaceShapes& shapes_;
  std::span<const std::uint32_t> seams_;
  std::vector<std::uint32_t> twin_;            // of the surface, less the seams
  std::vector<std::uint32_t> after_, before_;  // along the border
  CutChart disc_;
};

}  // namespace

CutChart cut_to_disc(const Surface& surface, const Region& region, const FaceShapes& shapes,
                     std::span<const std::uint32_t> seams) {
  return ChartCutter(surface, region, shapes, seams).build();
}

}  // namespace wrapatlas
