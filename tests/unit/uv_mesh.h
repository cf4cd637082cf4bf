// Small meshes with UVs for tests, and slow but obvious ways to look at charts.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "wrapatlas/charts.h"
#include "wrapatlas/mesh.h"

namespace wrapatlas::test {

/// Builds a mesh face by face; every corner gets its own position and UV entry unless shared.
class MeshBuilder {
 public:
  std::uint32_t position(Vec3 p) {
    mesh.positions.push_back(p);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
  }
  std::uint32_t texcoord(Vec2 uv) {
    mesh.texcoords.push_back(uv);
    return static_cast<std::uint32_t>(mesh.texcoords.size() - 1);
  }
  struct Corner {
    std::uint32_t position, texcoord;
  };
  void face(const std::vector<Corner>& corners) {
    for (const Corner& c : corners) {
      mesh.corner_position.push_back(c.position);
      mesh.corner_texcoord.push_back(c.texcoord);
    }
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
  }
  /// A face whose UVs are its positions' x and y; every corner is a new entry.
  void flat_face(const std::vector<Vec2>& points, double z = 0) {
    std::vector<Corner> corners;
    for (const Vec2 p : points) corners.push_back({position({p.x, p.y, z}), texcoord(p)});
    face(corners);
  }

  Mesh mesh;
};

/// How many triangles of the chart contain p in their interior.
inline int triangles_over(const Chart& chart, Vec2 p) {
  int count = 0;
  for (const auto& [a, b, c] : chart.triangles) {
    const double u = signed_area2(chart.points[a], chart.points[b], p);
    const double v = signed_area2(chart.points[b], chart.points[c], p);
    const double w = signed_area2(chart.points[c], chart.points[a], p);
    count += (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
  }
  return count;
}

/// Winding number of the outline around p, by the crossings of a ray to the right.
inline int winding_at(const Chart& chart, Vec2 p) {
  int winding = 0;
  for (const OutlineEdge& e : chart.outline) {
    const Vec2 a = chart.points[e.from], b = chart.points[e.to];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    const bool right = (signed_area2(a, b, p) > 0) == (b.y > a.y);
    if (right) winding += b.y > a.y ? e.winding : -e.winding;
  }
  return winding;
}

inline bool in_against_grain(const Chart& chart, Vec2 p) {
  Chart only;
  only.points = chart.points;
  for (const std::uint32_t t : chart.against_grain) only.triangles.push_back(chart.triangles[t]);
  return triangles_over(only, p) > 0;
}

inline Vec2 random_point(std::mt19937& random, const Box2& box) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double x = unit(random), y = unit(random);
  return {box.min.x + x * box.size().x, box.min.y + y * box.size().y};
}

}  // namespace wrapatlas::test
