#include "parameterize/disc.h"

#include <fmt/format.h>

#include "mesh/edge_groups.h"

namespace wrapatlas {
namespace {

/// Entries of a factor are many times the mesh's, and take gigabytes beyond.
constexpr std::size_t kMostTriangles = std::size_t{1} << 22;

/// Area of a chart, relative to the square of its size, that is not merely rounding.
constexpr double kSomeArea = 1e-15;

Error not_a_disc(std::string where, std::string what) {
  return {ErrorKind::input, std::move(where), std::move(what),
          "only a disc can be flattened: cut the chart into pieces that are discs"};
}

Error bad_array(std::string where, std::string what, std::string remedy) {
  return {ErrorKind::input, std::move(where), std::move(what), std::move(remedy)};
}

Status check_arrays(std::span<const Vec3> points, std::span<const Triangle> triangles) {
  if (triangles.empty()) {
    return bad_array("chart", "it has no triangles", "pass at least one triangle");
  }
  if (triangles.size() > kMostTriangles) {
    return bad_array("chart", fmt::format("it has {} triangles", triangles.size()),
                     fmt::format("cut it into charts of at most {}", kMostTriangles));
  }
  std::vector<bool> used(points.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    for (const std::uint32_t p : triangles[t]) {
      if (p >= points.size()) {
        return bad_array(fmt::format("triangle {}", t),
                         fmt::format("it refers to point {} of {}", p, points.size()),
                         "pass indices of points");
      }
      used[p] = true;
    }
    if (a == b || b == c || c == a) {
      return bad_array(fmt::format("triangle {}", t), "it has a point twice",
                       "leave out triangles that are edges or points");
    }
  }
  for (std::size_t p = 0; p < points.size(); ++p) {
    const auto usable = [](double x) { return std::abs(x) < 1e30; };
    if (!usable(points[p].x) || !usable(points[p].y) || !usable(points[p].z)) {
      return bad_array(fmt::format("point {}", p), "a coordinate is not a usable number",
                       "pass finite coordinates of magnitude below 1e30");
    }
    if (!used[p]) {
      return bad_array(fmt::format("point {}", p), "no triangle uses it",
                       "pass only the points of the chart");
    }
  }
  return Done{};
}

Status find_neighbours(Disc& disc) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * disc.triangles.size());
  for (std::size_t t = 0; t < disc.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = disc.triangles[t][i], b = disc.triangles[t][next3(i)];
      const auto half_edge = static_cast<std::uint32_t>(3 * t + i);
      uses.push_back({std::min(a, b), std::max(a, b), half_edge, a > b});
    }
  }
  gather_edges(uses, disc.points.size());
  disc.opposite.assign(uses.size(), kNone);
  const EdgeUse* crowded = nullptr;
  const EdgeUse* turned = nullptr;
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() > 2) crowded = edge.data();
    if (edge.size() != 2) return;
    if (edge[0].reversed == edge[1].reversed) turned = edge.data();
    disc.opposite[edge[0].face] = edge[1].face;
    disc.opposite[edge[1].face] = edge[0].face;
  });
  if (crowded != nullptr) {
    return not_a_disc(fmt::format("edge {}-{}", crowded->low, crowded->high),
                      "more than two triangles meet at it");
  }
  if (turned != nullptr) {
    return bad_array(fmt::format("edge {}-{}", turned->low, turned->high),
                     "its triangles are oriented against each other",
                     "orient all triangles alike, or cut the chart if it is one-sided");
  }
  return Done{};
}

/// Finds the border; each point may be on it once.
Status walk_border(Disc& disc) {
  std::vector<std::uint32_t> after(disc.points.size(), kNone);
  std::uint32_t first = kNone;
  std::size_t count = 0;
  for (std::size_t h = 0; h < disc.opposite.size(); ++h) {
    if (disc.opposite[h] != kNone) continue;
    const std::uint32_t a = disc.triangles[h / 3][h % 3], b = disc.triangles[h / 3][next3(h % 3)];
    if (after[a] != kNone) return not_a_disc(fmt::format("point {}", a), "the border meets itself");
    after[a] = b;
    first = std::min(first, a);
    ++count;
  }
  if (count == 0) return not_a_disc("chart", "it has no border");
  disc.on_border.assign(disc.points.size(), false);
  for (std::uint32_t p = first; !disc.on_border[p]; p = after[p]) {
    disc.on_border[p] = true;
    disc.border.push_back(p);
  }
  if (disc.border.size() != count) return not_a_disc("chart", "it has more than one border");
  return Done{};
}

/// Around each point there is one fan of triangles, and all triangles hang together.
Status check_connected(const Disc& disc) {
  std::vector<std::uint32_t> degree(disc.points.size(), 0), start(disc.points.size(), kNone);
  for (std::size_t h = 0; h < disc.opposite.size(); ++h) {
    const std::uint32_t p = disc.triangles[h / 3][h % 3];
    ++degree[p];
    // A walk counter-clockwise about a point of the border has to begin at the border.
    if (start[p] == kNone || disc.opposite[h] == kNone) start[p] = static_cast<std::uint32_t>(h);
  }
  for (std::size_t p = 0; p < disc.points.size(); ++p) {
    std::uint32_t seen = 0, h = start[p];
    do {
      ++seen;
      h = disc.opposite[h - h % 3 + static_cast<std::uint32_t>(prev3(h % 3))];
    } while (h != kNone && h != start[p]);
    if (seen != degree[p]) {
      return not_a_disc(fmt::format("point {}", p), "parts of the chart meet at it alone");
    }
  }
  std::vector<bool> reached(disc.triangles.size());
  std::vector<std::uint32_t> stack{0};
  reached[0] = true;
  std::size_t count = 0;
  while (!stack.empty()) {
    const std::uint32_t t = stack.back();
    stack.pop_back();
    ++count;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t h = disc.opposite[3 * t + i];
      if (h == kNone || reached[h / 3]) continue;
      reached[h / 3] = true;
      stack.push_back(h / 3);
    }
  }
  if (count != reached.size()) return not_a_disc("chart", "its triangles are not connected");
  return Done{};
}

/// With all the above, Euler's characteristic tells the disc from the disc with handles.
Status check_handles(const Disc& disc) {
  const std::size_t half_edges = disc.opposite.size();
  const std::size_t edges = (half_edges + disc.border.size()) / 2;
  if (disc.points.size() + disc.triangles.size() != edges + 1) {
    return not_a_disc("chart", "it has a handle");
  }
  return Done{};
}

Status normalise(std::span<const Vec3> points, Disc& disc) {
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 extent = high - low;
  disc.size = std::max({extent.x, extent.y, extent.z});
  disc.points.reserve(points.size());
  if (disc.size > 1e-150) {  // so that its square is a number
    for (const Vec3& p : points) disc.points.push_back((1 / disc.size) * (p - low));
    for (const auto& [a, b, c] : disc.triangles) {
      disc.area += length(cross(disc.points[b] - disc.points[a], disc.points[c] - disc.points[a]));
    }
    disc.area /= 2;
  }
  if (!(disc.area > kSomeArea)) {
    return bad_array("chart", "it has no area", "leave it out, or merge it with a neighbour");
  }
  return Done{};
}

}  // namespace

Result<Disc> make_disc(std::span<const Vec3> points, std::span<const Triangle> triangles) {
  Disc disc;
  disc.triangles = triangles;
  if (Status ok = check_arrays(points, triangles); !ok) return ok.error();
  if (Status ok = normalise(points, disc); !ok) return ok.error();
  for (auto* check : {find_neighbours, walk_border}) {
    if (Status ok = check(disc); !ok) return ok.error();
  }
  for (auto* check : {check_connected, check_handles}) {
    if (Status ok = check(disc); !ok) return ok.error();
  }
  return disc;
}

}  // namespace wrapatlas
