// The fast judge against a slow one: every pair of triangles at every shift, by clipping.
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "validate/polygon.h"
#include "validate/triangle_pair.h"
#include "wrapatlas/validate.h"

namespace wrapatlas {
namespace {

using Corners = std::array<Vec2, 3>;

double clipped_area(Corners a, Corners b) {
  if (signed_area2(b[0], b[1], b[2]) < 0) std::swap(b[1], b[2]);
  std::vector<Vec2> shape(a.begin(), a.end());
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<Vec2> kept;
    const auto side = [&](Vec2 p) { return signed_area2(b[i], b[(i + 1) % 3], p); };
    for (std::size_t j = 0; j < shape.size(); ++j) {
      const Vec2 p = shape[j], q = shape[(j + 1) % shape.size()];
      if (side(p) >= 0) kept.push_back(p);
      if (side(p) * side(q) < 0) kept.push_back(p + side(p) / (side(p) - side(q)) * (q - p));
    }
    shape = kept;
  }
  double area = 0;
  for (std::size_t j = 0; j < shape.size(); ++j)
    area += cross(shape[j], shape[(j + 1) % shape.size()]);
  return std::abs(area) / 2;
}

/// The distance from `a` to `b`, seen from points all along the outline of `a`: too large by at
/// most half their spacing.
double sampled_distance(const Corners& a, const Corners& b, int samples) {
  double least = 1e300;
  for (std::size_t i = 0; i < 3; ++i) {
    for (int k = 0; k <= samples; ++k) {
      const Vec2 p = a[i] + (1.0 * k / samples) * (a[(i + 1) % 3] - a[i]);
      for (std::size_t j = 0; j < 3; ++j) {
        const Vec2 along = b[(j + 1) % 3] - b[j];
        const double square = dot(along, along);
        const double t = square > 0 ? std::clamp(dot(p - b[j], along) / square, 0.0, 1.0) : 0;
        least = std::min(least, length(b[j] + t * along - p));
      }
    }
  }
  return least;
}

double corner_distance(const Corners& a, const Corners& b) {
  return std::min(sampled_distance(a, b, 1), sampled_distance(b, a, 1));
}

Corners shifted(const Corners& t, Vec2 by) { return {t[0] + by, t[1] + by, t[2] + by}; }

struct Judged {
  std::set<std::tuple<Violation, std::uint32_t, std::uint32_t>> found;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> distance;
};

/// Triangle i belongs to chart i / 2.
Judged judge_slowly(const std::vector<Corners>& soup, Vec2 size, Wrap wrap, double padding) {
  Judged judged;
  const int reach_u = wraps_u(wrap) ? 6 : 0, reach_v = wraps_v(wrap) ? 6 : 0;
  for (std::uint32_t i = 0; i < soup.size(); ++i) {
    for (std::uint32_t j = i; j < soup.size(); ++j) {
      const std::uint32_t a = i / 2, b = j / 2;
      for (int x = -reach_u; x <= reach_u; ++x) {
        for (int y = -reach_v; y <= reach_v; ++y) {
          if (a == b && x == 0 && y == 0) continue;
          const Corners other = shifted(soup[j], {x * size.x, y * size.y});
          const bool meet = clipped_area(soup[i], other) > 1e-9;
          const double distance = meet ? 0 : corner_distance(soup[i], other);
          if (meet)
            judged.found.insert({a == b ? Violation::self_overlap : Violation::overlap, a, b});
          auto [entry, fresh] = judged.distance.try_emplace({a, b}, distance);
          if (!fresh) entry->second = std::min(entry->second, distance);
        }
      }
    }
  }
  for (const auto& [pair, distance] : judged.distance) {
    const auto& [a, b] = pair;
    const Violation overlap = a == b ? Violation::self_overlap : Violation::overlap;
    if (distance < padding && !judged.found.contains({overlap, a, b})) {
      judged.found.insert({Violation::gap, a, b});
    }
  }
  return judged;
}

/// Charts of two triangles with a common edge.
Mesh mesh_of(const std::vector<Corners>& soup, Vec2 size) {
  Mesh mesh;
  for (std::size_t i = 0; i < soup.size(); ++i) {
    for (const Vec2 p : soup[i]) {
      const auto number = static_cast<std::uint32_t>(mesh.positions.size());
      const std::size_t layer = i / 2;
      mesh.positions.push_back({p.x, p.y, static_cast<double>(layer)});
      mesh.texcoords.push_back({p.x / size.x, p.y / size.y});
      mesh.corner_position.push_back(number);
      mesh.corner_texcoord.push_back(number);
    }
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
  }
  return mesh;
}

std::vector<Corners> random_soup(std::mt19937& random, std::size_t charts, Vec2 size) {
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Corners> soup;
  for (std::size_t i = 0; i < charts; ++i) {
    // Mostly small ones, now and then one longer than the domain; slivers and dots as well.
    const double kind = unit(random);
    const double extent = kind < 0.7 ? 0.05 : kind < 0.9 ? 0.3 : 1.5;
    const double thin = unit(random) < 0.3 ? 1e-3 : 1;
    const Vec2 at{(3 * unit(random) - 1) * size.x, (3 * unit(random) - 1) * size.y};
    const double angle = 6.3 * unit(random);
    const auto point = [&] {
      const Vec2 local{extent * unit(random) * size.x, extent * thin * unit(random) * size.x};
      return Similarity::from(1, angle, at).apply(local);
    };
    const Vec2 a = point(), b = point();
    soup.push_back({a, b, point()});
    soup.push_back({b, a, point()});
  }
  return soup;
}

TEST(ValidateOracle, RandomSoupsAreJudgedAlike) {
  std::mt19937 random(1234);
  std::size_t conflicts = 0, fine = 0;
  for (int round = 0; round < 80; ++round) {
    const Vec2 size{round % 3 == 0 ? 300.0 : 128.0, 128.0};
    const auto wrap = static_cast<Wrap>(round % 4);
    const double padding = round % 5 == 0 ? 0 : 0.7 * (round % 5);
    const std::size_t charts = round % 8 == 0 ? 60 : 3 + round % 7;
    const std::vector<Corners> soup = random_soup(random, charts, size);
    CheckOptions options;
    options.width = static_cast<int>(size.x);
    options.height = static_cast<int>(size.y);
    options.wrap = wrap;
    options.padding = padding;
    options.threads = 1 + round % 3;
    options.max_findings = 100000;
    // In a plane all of it is far from [0,1]; that is not what is asked here.
    const auto report = check_atlas(mesh_of(soup, size), nullptr, options);
    ASSERT_TRUE(report);
    const Judged slow = judge_slowly(soup, size, wrap, padding);
    std::set<std::tuple<Violation, std::uint32_t, std::uint32_t>> fast;
    double smallest = 1e300;
    for (const auto& [pair, distance] : slow.distance) smallest = std::min(smallest, distance);
    for (const Finding& finding : report->findings) {
      if (finding.kind == Violation::bounds) continue;
      fast.insert({finding.kind, finding.chart_a, finding.chart_b});
      if (finding.kind == Violation::gap) {
        const double expected = slow.distance.at({finding.chart_a, finding.chart_b});
        EXPECT_NEAR(finding.amount, expected, 1e-9);
      }
    }
    EXPECT_EQ(fast, slow.found) << "round " << round;
    if (smallest < padding + 0.5) {
      EXPECT_NEAR(report->smallest_gap, smallest, 1e-9);
    }
    conflicts += fast.size();
    fine += slow.distance.size() - fast.size();
  }
  EXPECT_GT(conflicts, 100U);
  EXPECT_GT(fine, 500U);
}

TEST(ValidateOracle, ThreadsDoNotChangeTheReport) {
  std::mt19937 random(99);
  const Vec2 size{256, 256};
  const Mesh mesh = mesh_of(random_soup(random, 4000, size), size);
  CheckOptions options;
  options.width = options.height = 256;
  options.wrap = Wrap::uv;
  options.padding = 1;
  options.max_findings = 500;
  options.threads = 1;
  const auto one = check_atlas(mesh, nullptr, options);
  options.threads = 3;
  const auto three = check_atlas(mesh, nullptr, options);
  ASSERT_TRUE(one && three);
  EXPECT_EQ(one->violations, three->violations);
  EXPECT_EQ(one->smallest_gap, three->smallest_gap);
  EXPECT_EQ(one->remarks, three->remarks);
  ASSERT_EQ(one->findings.size(), three->findings.size());
  for (std::size_t i = 0; i < one->findings.size(); ++i) {
    EXPECT_EQ(one->findings[i].text, three->findings[i].text);
  }
}

TEST(ValidateOracle, DistanceAndDepthOfPairs) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 10);
  std::size_t meet = 0;
  for (int round = 0; round < 10000; ++round) {
    Corners a, b;
    for (Vec2& p : a) p = {unit(random), unit(random)};
    for (Vec2& p : b) p = {unit(random) + 4, unit(random)};
    if (round % 7 == 0) b[2] = 0.5 * (b[0] + b[1]);
    if (round % 11 == 0) a[1] = a[2] = a[0];
    const double depth = validate::overlap_depth(a, b, 1e-9);
    const validate::Closest closest = validate::closest_points(a, b);
    const double area = clipped_area(a, b);
    EXPECT_TRUE(depth > 0 || area < 1e-7) << area;
    EXPECT_TRUE(area > 0 || depth < 1e-7) << depth;
    EXPECT_NEAR(length(closest.on_a - closest.on_b), closest.distance, 1e-12);
    EXPECT_FALSE(validate::surely_apart(a, b, closest.distance * (1 + 1e-9)));
    if (depth > 0) {
      ++meet;
      EXPECT_EQ(closest.distance, 0);
      const Vec2 middle = validate::middle_of_overlap(a, b);
      EXPECT_LT(sampled_distance({middle, middle, middle}, b, 1), 15);
      EXPECT_GT(clipped_area(a, {middle - Vec2{1e-3, 1e-3}, middle + Vec2{1e-3, 0}, middle}), 0);
    } else if (closest.distance > 0) {
      EXPECT_NEAR(closest.distance, sampled_distance(a, b, 100), 0.1);
      EXPECT_LE(closest.distance, sampled_distance(a, b, 100) + 1e-12);
    }
  }
  EXPECT_GT(meet, 2000U);
}

TEST(ValidateOracle, DepthIsAtMostTheWayOut) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(0, 10);
  for (int round = 0; round < 500; ++round) {
    Corners a, b;
    for (Vec2& p : a) p = {unit(random), unit(random)};
    for (Vec2& p : b) p = {unit(random), unit(random)};
    const double depth = validate::overlap_depth(a, b, 0);
    for (int k = 0; k < 64 && depth > 1e-3; ++k) {  // moved by less, they still overlap
      const double angle = k * 0.0981747704;
      const Vec2 way = 0.98 * depth * Vec2{std::cos(angle), std::sin(angle)};
      EXPECT_GT(clipped_area(a, shifted(b, way)), 0);
    }
  }
}

TEST(ValidateOracle, PolygonsAreCoveredOnce) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.1, 1);
  for (int round = 0; round < 300; ++round) {
    std::vector<Vec2> star;  // seen from its middle, so simple
    const int corners = 3 + round % 40;
    for (int i = 0; i < corners; ++i) {
      const double angle = (round % 2 == 0 ? 1 : -1) * 6.283185307 * i / corners;
      const double radius = unit(random);
      star.push_back({radius * std::cos(angle), radius * std::sin(angle)});
      if (i % 5 == 4)
        star.insert(star.end() - 1, 0.5 * (star[star.size() - 1] + star[star.size() - 2]));
    }
    double area = 0, sum = 0;
    for (std::size_t i = 0; i < star.size(); ++i)
      area += cross(star[i], star[(i + 1) % star.size()]) / 2;
    std::vector<validate::Triangle> triangles;
    EXPECT_FALSE(validate::cover_polygon(star, 1e-9, triangles));
    EXPECT_EQ(triangles.size(), star.size() - 2);
    for (const auto& t : triangles) sum += std::abs(signed_area2(t[0], t[1], t[2])) / 2;
    EXPECT_NEAR(sum, std::abs(area), 1e-9) << "round " << round;
  }
}

}  // namespace
}  // namespace wrapatlas
