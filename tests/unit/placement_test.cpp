// Parts of simplification against slow and obvious versions: where points go and what it costs,
// which edges may be collapsed, which is the cheapest.
#include "simplify/placement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "simplify/constraints.h"
#include "simplify/edge_queue.h"
#include "simplify_checks.h"

namespace wrapatlas {
namespace {

using test::Triangle;

struct Setting {
  Surface surface;
  CollapseMesh mesh;
  PatchGeometry geometry;

  explicit Setting(const Mesh& triangles)
      : surface(*build_surface(triangles)), mesh(surface), geometry(mesh, surface.points) {}

  [[nodiscard]] std::vector<Triangle> triangles() const {
    std::vector<Triangle> all;
    for (std::uint32_t f = 0; f < mesh.face_numbers(); ++f) {
      if (mesh.has_face(f)) {
        all.push_back({mesh.vertex(3 * f), mesh.vertex(3 * f + 1), mesh.vertex(3 * f + 2)});
      }
    }
    return all;
  }
};

/// The paper's sums, from the whole list of triangles, about the origin of the coordinates.
struct Oracle {
  std::vector<std::array<Vec3, 3>> touched;  ///< triangles at either end
  std::vector<std::array<Vec3, 2>> borders;  ///< border edges at either end
  std::vector<Vec3> link;                    ///< the other points of these triangles
  double edge2 = 0;

  Oracle(const Setting& s, std::uint32_t a, std::uint32_t b) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    std::set<std::uint32_t> points;
    const auto triangles = s.triangles();
    for (const Triangle& t : triangles) {
      for (std::size_t i = 0; i < 3; ++i) edges.emplace(t[i], t[(i + 1) % 3]);
      if (std::none_of(t.begin(), t.end(), [&](auto v) { return v == a || v == b; })) continue;
      touched.push_back(
          {s.geometry.position(t[0]), s.geometry.position(t[1]), s.geometry.position(t[2])});
      points.insert(t.begin(), t.end());
    }
    for (const auto& [p, q] : edges) {
      if (edges.count({q, p}) > 0 || (p != a && p != b && q != a && q != b)) continue;
      borders.push_back({s.geometry.position(p), s.geometry.position(q)});
    }
    for (const std::uint32_t p : points) {
      if (p != a && p != b) link.push_back(s.geometry.position(p));
    }
    const Vec3 edge = s.geometry.position(a) - s.geometry.position(b);
    edge2 = dot(edge, edge);
  }

  /// Of the tetrahedra between the triangles and v: the sum, and the sum of squares, times 6, 36.
  [[nodiscard]] std::array<double, 2> volumes(const Vec3& v) const {
    double sum = 0, squares = 0;
    for (const auto& [p, q, r] : touched) {
      const double six = dot(p - v, cross(q - v, r - v));
      sum += six;
      squares += six * six;
    }
    return {sum, squares};
  }
  /// Of the triangles between border edges and v: the sum of vectors, and of squares, times 2, 4.
  [[nodiscard]] std::pair<Vec3, double> areas(const Vec3& v) const {
    Vec3 sum;
    double squares = 0;
    for (const auto& [p, q] : borders) {
      const Vec3 twice = cross(p - v, q - v);
      sum = sum + twice;
      squares += dot(twice, twice);
    }
    return {sum, squares};
  }
  [[nodiscard]] double cost(const Vec3& v) const {
    return volumes(v)[1] / 72 + edge2 * areas(v).second / 8;
  }
};

TEST(Placement, KeepsVolumeAndIsBestAsFarAsThatGoes) {
  std::mt19937_64 random(1);
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const Setting s(test::bumpy_ball(7, 0.08, seed));
    for (std::uint32_t e = 0; e < s.mesh.edge_numbers(); ++e) {
      const std::uint32_t c = s.mesh.corner_of_edge(e);
      const Oracle oracle(s, s.mesh.vertex(c), s.mesh.vertex(s.mesh.next(c)));
      const EdgePlacement placed = place(s.mesh, s.geometry, c, {});
      Vec3 normal;
      double size = 0;
      for (const auto& [p, q, r] : oracle.touched) {
        normal = normal + cross(q - p, r - p);
        size += length(cross(q - p, r - p));
      }
      EXPECT_NEAR(oracle.volumes(placed.point)[0], 0, 1e-13 * size);
      const double cubed = oracle.edge2 * oracle.edge2 * oracle.edge2;
      EXPECT_NEAR(placed.cost, oracle.cost(placed.point) + 1e-9 / 36 * cubed,
                  1e-9 * placed.cost + 1e-14 * cubed);
      for (int i = 0; i < 20; ++i) {  // steps within the plane of that volume
        Vec3 step{test::uniform(random, -1, 1), test::uniform(random, -1, 1),
                  test::uniform(random, -1, 1)};
        step = step - dot(step, normal) / dot(normal, normal) * normal;
        const Vec3 beside = placed.point + 1e-3 * step;
        EXPECT_GE(oracle.cost(beside), oracle.cost(placed.point) * (1 - 1e-9)) << e;
      }
    }
  }
}

TEST(Placement, KeepsTheAreaBesideABorder) {
  std::mt19937_64 random(2);
  const Mesh wavy = test::grid_mesh(6, 6, {false, false}, false, [](double u, double v) {
    return Vec3{u + 0.1 * std::sin(7 * v), v + 0.1 * std::sin(5 * u),
                0.2 * std::sin(4 * u + 3 * v)};
  });
  const Setting s(wavy);
  int seen = 0;
  for (std::uint32_t e = 0; e < s.mesh.edge_numbers(); ++e) {
    const std::uint32_t c = s.mesh.corner_of_edge(e);
    const Oracle oracle(s, s.mesh.vertex(c), s.mesh.vertex(s.mesh.next(c)));
    if (oracle.borders.empty() || oracle.borders.size() > 3) continue;
    ++seen;
    const EdgePlacement placed = place(s.mesh, s.geometry, c, {});
    const Vec3 sum = oracle.areas(placed.point).first;
    for (int i = 0; i < 20; ++i) {
      const Vec3 step{test::uniform(random, -1, 1), test::uniform(random, -1, 1),
                      test::uniform(random, -1, 1)};
      EXPECT_GE(length(oracle.areas(placed.point + 1e-3 * step).first), length(sum) - 1e-12);
    }
    const double cubed = oracle.edge2 * oracle.edge2 * oracle.edge2;
    EXPECT_NEAR(placed.cost, oracle.cost(placed.point) + 1e-9 / 36 * cubed, 1e-9 * placed.cost);
  }
  EXPECT_GT(seen, 60);
}

TEST(Placement, InAPlaneItIsTheMiddleOfTheLink) {
  Mesh flat = test::sheet(6);
  for (Vec3& p : flat.positions) p = {p.x, 0.6 * p.y + 5, 0.8 * p.y};
  const Setting s(flat);
  int seen = 0;
  for (std::uint32_t e = 0; e < s.mesh.edge_numbers(); ++e) {
    const std::uint32_t c = s.mesh.corner_of_edge(e);
    const Oracle oracle(s, s.mesh.vertex(c), s.mesh.vertex(s.mesh.next(c)));
    const EdgePlacement placed = place(s.mesh, s.geometry, c, {});
    if (!oracle.borders.empty()) continue;
    ++seen;
    Vec3 middle;
    for (const Vec3& p : oracle.link) middle = middle + 1.0 / double(oracle.link.size()) * p;
    EXPECT_NEAR(length(placed.point - middle), 0, 1e-13);
  }
  EXPECT_GT(seen, 30);
}

TEST(Constraints, NeedAnAngleOfOneDegree) {
  const auto at = [](double degrees) {
    const double a = degrees * std::numbers::pi / 180;
    return Vec3{std::cos(a), std::sin(a), 0};
  };
  for (const auto& [degrees, counts] : {std::pair{0.9, false}, {1.1, true}, {179.1, false}}) {
    Constraints constraints;
    constraints.add({2, 0, 0}, 6);
    constraints.add(at(degrees), 100);
    constraints.add({0, 1, 0}, 5);
    constraints.add({0, 0, 3}, 6);
    ASSERT_TRUE(constraints.complete());
    const Vec3 point = constraints.point();
    EXPECT_NEAR(point.x, 3, 1e-12);
    EXPECT_NEAR(point.z, 2, 1e-12);
    EXPECT_EQ(std::abs(point.y - 5) > 1, counts);
  }
  for (const auto& [degrees, counts] : {std::pair{0.9, false}, {1.1, true}}) {
    const Vec3 tilted = at(degrees);  // out of the plane of the first two
    Constraints constraints;
    constraints.add({1, 0, 0}, 0);
    constraints.add({0, 1, 0}, 0);
    constraints.add({tilted.x, 0, tilted.y}, 1);
    EXPECT_EQ(constraints.complete(), counts);
  }
}

/// The triangles with the edge from a to b collapsed, whatever comes of it.
std::vector<Triangle> collapsed(std::vector<Triangle> triangles, std::uint32_t a, std::uint32_t b) {
  std::vector<Triangle> left;
  for (Triangle t : triangles) {
    std::replace(t.begin(), t.end(), b, a);
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) left.push_back(t);
  }
  return left;
}

std::size_t points_of(const std::vector<Triangle>& triangles) {
  std::set<std::uint32_t> points;
  for (const Triangle& t : triangles) points.insert(t.begin(), t.end());
  return points.size();
}

TEST(CollapseMesh, CollapsesWhatKeepsTheTopologyAndNothingElse) {
  const std::vector<Mesh> meshes{test::ball(4),
                                 test::torus(4),
                                 test::tube(4, 1),
                                 test::sheet(3),
                                 test::grid_mesh(4, 1, {false, false}, false,
                                                 [](double u, double v) {
                                                   return Vec3{u, v, 0};
                                                 }),
                                 test::both(test::ball(3), test::moved(test::sheet(2), {9, 0, 0}))};
  int may = 0, may_not = 0;
  for (const Mesh& mesh : meshes) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      std::mt19937_64 random(seed);
      Setting s(mesh);
      while (true) {
        const auto triangles = s.triangles();
        const auto topology = test::topology_of(triangles);
        ASSERT_TRUE(topology.is_manifold);
        std::vector<std::uint32_t> candidates;
        for (std::uint32_t e = 0; e < s.mesh.edge_numbers(); ++e) {
          const std::uint32_t c = s.mesh.corner_of_edge(e);
          if (c == kNone) continue;
          ASSERT_EQ(s.mesh.edge(c), e);
          const std::uint32_t a = s.mesh.vertex(c), b = s.mesh.vertex(s.mesh.next(c));
          const auto after = collapsed(triangles, a, b);
          const bool keeps = test::topology_of(after) == topology &&
                             points_of(after) + 1 == points_of(triangles);  // b alone is gone
          ASSERT_EQ(s.mesh.can_collapse(c), keeps)
              << triangles.size() << " triangles, seed " << seed;
          (keeps ? may : may_not) += 1;
          if (keeps) candidates.push_back(c);
        }
        if (candidates.empty()) break;
        const std::uint32_t c = candidates[random() % candidates.size()];
        auto expected = collapsed(triangles, s.mesh.vertex(c), s.mesh.vertex(s.mesh.next(c)));
        s.mesh.collapse(c);
        EXPECT_EQ(s.triangles(), expected);
        EXPECT_EQ(s.mesh.face_count(), expected.size());
      }
    }
  }
  EXPECT_GT(may, 1000);
  EXPECT_GT(may_not, 1000);
}

/// The lowest of the costs that count as equal to it.
double rounded_down(double cost) {
  if (cost < std::numeric_limits<double>::min()) return 0;  // of those that are tried
  int exponent = 0;
  const double mantissa = std::frexp(cost, &exponent);  // from a half up: eight steps
  return std::ldexp(std::floor(16 * mantissa), exponent - 4);
}

TEST(EdgeQueue, GivesTheCheapestAlways) {
  std::mt19937_64 random(3);
  EdgeQueue queue(200);
  std::map<std::uint32_t, double> costs;
  int equal = 0, risen = 0, fallen = 0;
  double last = 0;
  for (int step = 0; step < 40000; ++step) {
    const auto edge = static_cast<std::uint32_t>(random() % 200);
    if (random() % 3 == 0) {
      queue.remove(edge);
      costs.erase(edge);
    } else {
      const double cost = random() % 20 == 0 ? 0 : std::exp2(test::uniform(random, -30, 30));
      costs[edge] = cost;
      queue.set(edge, cost);
    }
    ASSERT_EQ(queue.empty(), costs.empty());
    ASSERT_EQ(queue.has(edge), costs.contains(edge));
    if (costs.empty() || random() % 4 != 0) continue;
    const auto before = [](const auto& a, const auto& b) {
      return std::pair(rounded_down(a.second), a.first) <
             std::pair(rounded_down(b.second), b.first);
    };
    const auto least = std::min_element(costs.begin(), costs.end(), before);
    ASSERT_EQ(queue.top(), least->first);
    const double of_least = rounded_down(least->second);
    equal += std::any_of(costs.begin(), costs.end(), [&](const auto& other) {
      return other.first != least->first && rounded_down(other.second) == of_least;
    });
    (of_least > last ? risen : fallen) += of_least != last ? 1 : 0;
    last = of_least;
    if (random() % 2 == 0) {  // as if it were collapsed
      queue.remove(least->first);
      costs.erase(least);
    }
  }
  EXPECT_GT(equal, 100);
  EXPECT_GT(risen, 1000);
  EXPECT_GT(fallen, 1000);
}

TEST(EdgeQueue, EmptiesInTheOrderOfCosts) {
  constexpr double kLargest = std::numeric_limits<double>::infinity();
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  std::mt19937_64 random(4);
  std::vector<double> costs{0, kLeast, kLargest, std::numeric_limits<double>::max()};
  while (costs.size() < 5000) costs.push_back(std::exp2(test::uniform(random, -1000, 1000)));
  EdgeQueue queue(5000);
  for (std::uint32_t edge = 0; edge < 5000; ++edge) {
    queue.set(edge, costs[edge]);
    queue.set(edge, 1);  // to another class and back: it stands in its own twice
    queue.set(edge, costs[edge]);
  }
  std::pair<double, std::uint32_t> last{-1, 0};
  for (int left = 5000; left > 0; --left) {
    ASSERT_FALSE(queue.empty());
    const std::uint32_t edge = queue.top();
    const double cost = costs[edge];
    const std::pair now{std::isinf(cost) ? cost : rounded_down(cost), edge};
    ASSERT_LT(last, now);
    last = now;
    queue.remove(edge);
    if (left % 5 == 0) {  // of the class that is being emptied
      queue.set(edge, cost);
      ASSERT_EQ(queue.top(), edge);
      queue.remove(edge);
    }
  }
  EXPECT_TRUE(queue.empty());
  queue.set(7, 0);  // below all that was there
  EXPECT_EQ(queue.top(), 7U);
}

}  // namespace
}  // namespace wrapatlas
