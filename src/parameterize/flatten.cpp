#include <algorithm>
#include <cmath>
#include <map>

#include "parameterize/angles.h"
#include "wrapatlas/parameterize.h"

namespace wrapatlas {

std::vector<Angles> clamped_angles(std::span<const Vec3> points,
                                   std::span<const Triangle> triangles) {
  const double least = 3 * M_PI / 180, most = 175 * M_PI / 180;
  std::vector<Angles> angles;
  for (const Triangle& t : triangles) {
    Angles a;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 u = points[t[(i + 1) % 3]] - points[t[i]],
                 v = points[t[(i + 2) % 3]] - points[t[i]];
      a[i] = std::clamp(std::atan2(length(cross(u, v)), dot(u, v)), least, most);
    }
    angles.push_back(a);
  }
  return angles;
}

std::vector<bool> border_points(std::size_t point_count, std::span<const Triangle> triangles) {
  // edges used once: by sorting
  std::vector<std::uint64_t> edges;
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint64_t a = t[i], b = t[(i + 1) % 3];
      edges.push_back(std::min(a, b) << 32 | std::max(a, b));
    }
  std::sort(edges.begin(), edges.end());
  std::vector<bool> border(point_count, false);
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i;
    while (j < edges.size() && edges[j] == edges[i]) ++j;
    if (j - i == 1) border[edges[i] >> 32] = border[edges[i] & 0xffffffff] = true;
    i = j;
  }
  return border;
}

Result<Flattening> flatten_disc(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                const FlattenOptions& options) {
  Flattening flat;
  flat.method = options.method;
  const auto border = border_points(points.size(), triangles);
  const auto own = clamped_angles(points, triangles);
  auto angles = own;
  if (options.method == FlattenMethod::labf &&
      !flatten_angles(angles, triangles, border, options.iterations, flat.wheel_residual)) {
    flat.method = FlattenMethod::lscm;
  }
  flat.uv = lay_out(points, triangles, flat.method == FlattenMethod::labf ? angles : own, border);
  if (flat.uv.empty()) return Error{ErrorKind::input, "chart", "unsolvable", ""};
  double a2 = 0, a3 = 0;
  for (const Triangle& t : triangles) {
    a2 += 0.5 * signed_area2(flat.uv[t[0]], flat.uv[t[1]], flat.uv[t[2]]);
    a3 += triangle_area(points, t);
  }
  if (!(a2 > 0)) return Error{ErrorKind::input, "chart", "unsolvable", ""};
  for (Vec2& p : flat.uv) p = std::sqrt(a3 / a2) * p;
  return flat;
}

Distortion measure_distortion(std::span<const Vec3> points, std::span<const Vec2> uv,
                              std::span<const Triangle> triangles) {
  Distortion d;
  double sum = 0, a3s = 0, a2s = 0, angle = 0, area = 0, most = 0;
  for (const Triangle& t : triangles) {
    a3s += triangle_area(points, t);
    a2s += 0.5 * signed_area2(uv[t[0]], uv[t[1]], uv[t[2]]);
  }
  for (const Triangle& t : triangles) {
    const double a3 = triangle_area(points, t);
    const double A2 = signed_area2(uv[t[0]], uv[t[1]], uv[t[2]]);
    if (a3 == 0) {
      if (A2 < 0) ++d.flipped;
      continue;
    }
    if (A2 <= 0) {
      ++d.flipped;
      continue;
    }
    const Vec3 &q1 = points[t[0]], &q2 = points[t[1]], &q3 = points[t[2]];
    const Vec2 p1 = uv[t[0]], p2 = uv[t[1]], p3 = uv[t[2]];
    const Vec3 ss = (1 / A2) * ((p2.y - p3.y) * q1 + (p3.y - p1.y) * q2 + (p1.y - p2.y) * q3);
    const Vec3 st = (1 / A2) * ((p3.x - p2.x) * q1 + (p1.x - p3.x) * q2 + (p2.x - p1.x) * q3);
    const double a = dot(ss, ss), b = dot(ss, st), c = dot(st, st);
    sum += 0.5 * (a + c) * a3;
    most = std::max(most, std::sqrt(0.5 * (a + c + std::sqrt((a - c) * (a - c) + 4 * b * b))));
    angle += a3 * (a + c) / (2 * std::sqrt(std::max(1e-300, a * c - b * b)));
    const double r = 0.5 * A2 / a3 * a3s / a2s;
    area += a3 * std::max(r, 1 / r);
  }
  d.l2 = d.flipped ? INFINITY : std::sqrt(sum / a3s) * std::sqrt(a2s / a3s);
  d.linf = d.flipped ? INFINITY : most * std::sqrt(a2s / a3s);
  d.angle = angle / a3s;
  d.area = area / a3s;
  return d;
}

bool border_crosses(std::span<const Vec2> uv, std::span<const Triangle> triangles) {
  std::vector<std::uint64_t> edges;
  for (const Triangle& t : triangles)
    for (std::size_t i = 0; i < 3; ++i) edges.push_back(std::uint64_t{t[i]} << 32 | t[(i + 1) % 3]);
  std::sort(edges.begin(), edges.end());
  struct E {
    std::uint32_t a, b;
    double lo, hi;
  };
  std::vector<E> border;
  for (const std::uint64_t e : edges) {
    const std::uint64_t r = e << 32 | e >> 32;
    if (std::binary_search(edges.begin(), edges.end(), r)) continue;
    const auto a = std::uint32_t(e >> 32), b = std::uint32_t(e);
    border.push_back({a, b, std::min(uv[a].x, uv[b].x), std::max(uv[a].x, uv[b].x)});
  }
  std::sort(border.begin(), border.end(), [](const E& x, const E& y) { return x.lo < y.lo; });
  for (std::size_t i = 0; i < border.size(); ++i)
    for (std::size_t j = i + 1; j < border.size() && border[j].lo <= border[i].hi; ++j) {
      const E &e = border[i], &f = border[j];
      if (std::max(uv[e.a].y, uv[e.b].y) < std::min(uv[f.a].y, uv[f.b].y) ||
          std::max(uv[f.a].y, uv[f.b].y) < std::min(uv[e.a].y, uv[e.b].y))
        continue;
      if (e.a == f.a || e.a == f.b || e.b == f.a || e.b == f.b) continue;
      const double o1 = signed_area2(uv[e.a], uv[e.b], uv[f.a]),
                   o2 = signed_area2(uv[e.a], uv[e.b], uv[f.b]);
      const double o3 = signed_area2(uv[f.a], uv[f.b], uv[e.a]),
                   o4 = signed_area2(uv[f.a], uv[f.b], uv[e.b]);
      if (o1 * o2 <= 0 && o3 * o4 <= 0) return true;
    }
  return false;
}

}  // namespace wrapatlas
