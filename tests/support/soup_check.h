// A slow judge of packings for tests: every pair of triangles, every shift. Knows nothing of grids.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "wrapatlas/pack.h"

namespace wrapatlas::test {

using Triangle = std::array<Vec2, 3>;

inline double point_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 ab = b - a;
  const double norm = dot(ab, ab);
  const double t = norm > 0 ? std::clamp(dot(p - a, ab) / norm, 0.0, 1.0) : 0;
  return length(p - (a + t * ab));
}

inline bool contains(const Triangle& t, Vec2 p) {
  const double a = signed_area2(t[0], t[1], p), b = signed_area2(t[1], t[2], p),
               c = signed_area2(t[2], t[0], p);
  return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
}

inline double triangle_distance(const Triangle& p, const Triangle& q) {
  if (contains(p, q[0]) || contains(q, p[0])) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Vec2 a = p[i], b = p[(i + 1) % 3], c = q[j], d = q[(j + 1) % 3];
      if (signed_area2(a, b, c) * signed_area2(a, b, d) < 0 &&
          signed_area2(c, d, a) * signed_area2(c, d, b) < 0) {
        return 0;
      }
      least = std::min({least, point_segment(a, c, d), point_segment(c, a, b)});
    }
  }
  return least;
}

/// Empty if the padding and margin promises hold, else what is wrong first.
inline std::string check_packing(const std::vector<Chart>& charts, const Packing& packing,
                                 const PackOptions& options) {
  std::vector<std::vector<Triangle>> placed;
  std::vector<Box2> boxes;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const Similarity move = packing.transform(i);
    std::vector<Triangle> triangles;
    Box2 box;
    for (const auto& t : charts[i].triangles) {
      triangles.push_back({move.apply(charts[i].points[t[0]]), move.apply(charts[i].points[t[1]]),
                           move.apply(charts[i].points[t[2]])});
      for (const Vec2 p : triangles.back()) box.add(p);
    }
    placed.push_back(std::move(triangles));
    boxes.push_back(box);
  }
  const double margin = options.margin < 0 ? options.padding / 2 : options.margin;
  const double tolerance = 1e-9;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const bool low = (!wraps_u(packing.wrap) && boxes[i].min.x < margin - tolerance) ||
                     (!wraps_v(packing.wrap) && boxes[i].min.y < margin - tolerance);
    const bool high =
        (!wraps_u(packing.wrap) && boxes[i].max.x > packing.width - margin + tolerance) ||
        (!wraps_v(packing.wrap) && boxes[i].max.y > packing.height - margin + tolerance);
    if (low || high) return "chart " + std::to_string(i) + " breaks the margin";
  }
  // Shifts that can bring any two boxes together: positions are within a few periods.
  const int reach_u = wraps_u(packing.wrap) ? 8 : 0, reach_v = wraps_v(packing.wrap) ? 8 : 0;
  for (std::size_t i = 0; i < charts.size(); ++i) {
    for (std::size_t j = i; j < charts.size(); ++j) {
      for (int u = -reach_u; u <= reach_u; ++u) {
        for (int v = -reach_v; v <= reach_v; ++v) {
          if (i == j && u == 0 && v == 0) continue;
          const Vec2 shift{double(u) * packing.width, double(v) * packing.height};
          const auto apart = [&](double a, double b, double c, double d) {
            return a - d > options.padding || c - b > options.padding;
          };
          if (apart(boxes[i].min.x, boxes[i].max.x, boxes[j].min.x + shift.x,
                    boxes[j].max.x + shift.x) ||
              apart(boxes[i].min.y, boxes[i].max.y, boxes[j].min.y + shift.y,
                    boxes[j].max.y + shift.y)) {
            continue;
          }
          for (const Triangle& p : placed[i]) {
            for (Triangle q : placed[j]) {
              for (Vec2& corner : q) corner = corner + shift;
              const double distance = triangle_distance(p, q);
              // With padding 0 a distance of 0 would be touching; the packers leave a slack.
              if (distance < std::max(options.padding, 1e-9)) {
                return "charts " + std::to_string(i) + " and " + std::to_string(j) + " are " +
                       std::to_string(distance) + " apart";
              }
            }
          }
        }
      }
    }
  }
  return "";
}

/// Empty if no two charts have a point in the same block (modulo the texture).
inline std::string check_blocks(const std::vector<Chart>& charts, const Packing& packing,
                                int block) {
  const int columns = packing.width / block, rows = packing.height / block;
  std::vector<std::size_t> owner(static_cast<std::size_t>(columns * rows), charts.size());
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const Similarity move = packing.transform(i);
    for (const auto& t : charts[i].triangles) {
      for (int a = 0; a <= 60; ++a) {
        for (int b = 0; a + b <= 60; ++b) {
          const double s = a / 60.0, r = b / 60.0;
          const Vec2 p = move.apply(s * charts[i].points[t[0]] + r * charts[i].points[t[1]] +
                                    (1 - s - r) * charts[i].points[t[2]]);
          const int x = static_cast<int>(std::floor(p.x / block)),
                    y = static_cast<int>(std::floor(p.y / block));
          const int column = (x % columns + columns) % columns, row = (y % rows + rows) % rows;
          std::size_t& cell = owner[static_cast<std::size_t>(row * columns + column)];
          if (cell != charts.size() && cell != i) {
            return "charts " + std::to_string(cell) + " and " + std::to_string(i) +
                   " share a block";
          }
          cell = i;
        }
      }
    }
  }
  return "";
}

}  // namespace wrapatlas::test
