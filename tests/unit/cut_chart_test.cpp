// Regions of any topology are cut to discs.
#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <set>

#include "segment/cut_chart.h"
#include "segment/grow.h"
#include "segment/seams.h"
#include "support/solids.h"

namespace wrapatlas {
namespace {

struct Whole {
  Surface surface;
  FaceShapes shapes;
  FaceOwners owners;
  Region region;
};

/// All faces of a mesh as one region.
Whole whole(const Mesh& mesh) {
  Whole w;
  w.surface = *build_surface(mesh);
  w.shapes = face_shapes(w.surface);
  w.owners.chart.assign(w.surface.face_count(), 0);
  w.owners.place.assign(w.surface.face_count(), 0);
  std::vector<std::uint32_t> faces(w.surface.face_count());
  std::iota(faces.begin(), faces.end(), 0U);
  w.region = make_region(w.surface, std::move(faces), w.owners, 0);
  return w;
}

CutChart disc_of(const Whole& w, std::span<const std::uint32_t> seams = {}) {
  return cut_to_disc(w.surface, w.region, w.shapes, seams);
}

/// Connected, of Euler characteristic 1, with one border that meets no point twice.
void expect_disc(const CutChart& disc) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::vector<std::uint32_t> next(disc.points.size(), kNone);
  std::size_t border = 0;
  for (std::uint32_t c = 0; c < disc.corner_point.size(); ++c) {
    const std::uint32_t a = disc.corner_point[c], b = disc.corner_point[disc.next(c)];
    EXPECT_NE(a, b);
    edges.insert({std::min(a, b), std::max(a, b)});
    if (disc.corner_twin[c] != kNone) continue;
    EXPECT_EQ(next[a], kNone) << "the border meets point " << a << " twice";
    next[a] = b;
    ++border;
  }
  const std::size_t faces = disc.corner_begin.size() - 1;
  EXPECT_EQ(disc.points.size() + faces, edges.size() + 1);
  std::uint32_t at = 0;
  while (at < next.size() && next[at] == kNone) ++at;
  ASSERT_LT(at, next.size()) << "no border";
  std::size_t steps = 0;
  for (std::uint32_t p = next[at]; p != at && steps < border; p = next[p]) ++steps;
  EXPECT_EQ(steps + 1, border) << "more than one border";
}

TEST(CutToDisc, EveryTopology) {
  expect_disc(disc_of(whole(test::sheet(4))));
  expect_disc(disc_of(whole(test::sheet(4, true))));
  expect_disc(disc_of(whole(test::tube(4, 2))));
  expect_disc(disc_of(whole(test::torus(6))));
  expect_disc(disc_of(whole(test::torus(6, 0.3, true))));
  expect_disc(disc_of(whole(test::moebius(9))));
}

TEST(CutToDisc, ASheetStaysWhole) {
  const Whole w = whole(test::sheet(6));
  EXPECT_EQ(disc_of(w).points.size(), w.surface.points.size());
}

TEST(CutToDisc, ATubeIsCutAlongOneWay) {
  const Whole w = whole(test::tube(5, 3));
  EXPECT_EQ(disc_of(w).points.size(), w.surface.points.size() + 6)
      << "five edges, six points twice";
}

TEST(CutToDisc, ASphereKeepsOneEdgeOpenUnlessThereAreSeams) {
  const Whole w = whole(test::ball(6));
  const CutChart closed = disc_of(w);
  EXPECT_TRUE(closed.is_closed);
  EXPECT_EQ(closed.points.size(), w.surface.points.size());
  const auto seams = cut_open(w.surface, w.region, closed);
  EXPECT_TRUE(std::is_sorted(seams.begin(), seams.end()));
  const CutChart open = disc_of(w, seams);
  EXPECT_FALSE(open.is_closed);
  expect_disc(open);
  EXPECT_EQ(open.points.size(), w.surface.points.size() + seams.size() / 2 - 1);
  EXPECT_GE(seams.size() / 2, 6U) << "from pole to pole, or as far";
}

TEST(CutToDisc, KeepsEverySeam) {
  const Whole w = whole(test::sheet(5));
  // The two triangles of the middle square are joined along no edge of their border.
  std::vector<std::uint32_t> seams;
  const std::uint32_t face = 2 * (2 * 5 + 2);
  for (std::uint32_t c = w.surface.face_begin[face]; c < w.surface.face_begin[face] + 2; ++c) {
    seams.push_back(c);
    seams.push_back(w.surface.corner_twin[c]);
  }
  std::sort(seams.begin(), seams.end());
  const CutChart disc = disc_of(w, seams);
  expect_disc(disc);
  EXPECT_GT(disc.points.size(), w.surface.points.size());
}

TEST(SeamsToShrunk, ReachTheTip) {
  // A sock: the upper half of a long ball, flattened as if seen from above: its tip shrinks.
  const Mesh ball = test::ball(12, 6);
  Whole w = whole(ball);
  std::vector<std::uint32_t> upper;
  for (std::uint32_t f = 0; f < w.surface.face_count(); ++f) {
    w.owners.chart[f] = w.shapes.centroid[f].z > 0 ? 0 : 1;
    if (w.owners.chart[f] == 0) upper.push_back(f);
  }
  w.region = make_region(w.surface, upper, w.owners, 0);
  const CutChart sock = disc_of(w);
  expect_disc(sock);
  std::vector<Vec2> uv;
  std::uint32_t tip = 0;
  for (std::uint32_t p = 0; p < sock.points.size(); ++p) {
    const Vec3 q = sock.points[p];
    if (q.z > sock.points[tip].z) tip = p;
    const double shrink = std::exp(-q.z / 2);
    uv.push_back({3 * shrink * q.x, 3 * shrink * q.y});
  }
  const auto seams = seams_to_shrunk(w.surface, w.region, sock, uv, 0.25);
  ASSERT_FALSE(seams.empty());
  const CutChart cut = disc_of(w, seams);
  expect_disc(cut);
  std::vector<bool> is_border(cut.points.size(), false);
  for (std::uint32_t c = 0; c < cut.corner_point.size(); ++c) {
    if (cut.corner_twin[c] == kNone) is_border[cut.corner_point[c]] = true;
  }
  bool reaches = false;
  for (std::uint32_t p = 0; p < cut.points.size(); ++p) {
    reaches = reaches || (is_border[p] && cut.points[p].z > 4);
  }
  EXPECT_TRUE(reaches);
  EXPECT_TRUE(seams_to_shrunk(w.surface, w.region, sock, uv, 1e-9).empty())
      << "nothing is so small";
}

TEST(Grow, EveryFaceGoesToOneOfItsSeeds) {
  const Whole w = whole(test::torus(8));
  const Growth growth = grow_charts(w.surface, w.region, w.shapes, 5, 10);
  std::set<std::uint32_t> seeds(growth.seed_of.begin(), growth.seed_of.end());
  EXPECT_EQ(seeds, (std::set<std::uint32_t>{0, 1, 2, 3, 4}));
  for (const std::uint32_t chart : seeds) {  // each chart is connected
    std::vector<std::uint32_t> part;
    std::size_t size = 0;
    std::vector<bool> reached(w.region.size(), false);
    for (std::uint32_t f = 0; f < w.region.size(); ++f) {
      if (growth.seed_of[f] != chart) continue;
      ++size;
      if (part.empty()) part.push_back(f), reached[f] = true;
    }
    for (std::size_t i = 0; i < part.size(); ++i) {
      for (const Region::Arc arc : w.region.arcs_of(part[i])) {
        if (reached[arc.to] || growth.seed_of[arc.to] != chart) continue;
        reached[arc.to] = true;
        part.push_back(arc.to);
      }
    }
    EXPECT_EQ(part.size(), size);
  }
}

TEST(Grow, SmoothBordersAreShorterAndPartNoChart) {
  const Whole w = whole(test::torus(10));
  std::mt19937 random(4);
  const auto border = [&](const Growth& growth) {
    double sum = 0;
    for (std::uint32_t f = 0; f < w.region.size(); ++f) {
      for (const Region::Arc arc : w.region.arcs_of(f)) {
        if (growth.seed_of[f] == growth.seed_of[arc.to]) continue;
        sum += length(w.surface.points[w.surface.corner_vertex[arc.corner]] -
                      w.surface.points[w.surface.corner_vertex[w.surface.next(arc.corner)]]);
      }
    }
    return sum;
  };
  const auto parts = [&](const Growth& growth) {  // connected ones
    std::vector<bool> reached(w.region.size(), false);
    std::size_t count = 0;
    for (std::uint32_t f = 0; f < w.region.size(); ++f) {
      if (reached[f]) continue;
      ++count;
      std::vector<std::uint32_t> part{f};
      reached[f] = true;
      for (std::size_t i = 0; i < part.size(); ++i) {
        for (const Region::Arc arc : w.region.arcs_of(part[i])) {
          if (reached[arc.to] || growth.seed_of[arc.to] != growth.seed_of[f]) continue;
          reached[arc.to] = true;
          part.push_back(arc.to);
        }
      }
    }
    return count;
  };
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<std::uint32_t> seeds;
    for (int i = 0; i < 12; ++i) {
      const auto seed = static_cast<std::uint32_t>(random() % w.region.size());
      if (std::find(seeds.begin(), seeds.end(), seed) == seeds.end()) seeds.push_back(seed);
    }
    Growth growth = grow(w.region, w.shapes, seeds);
    const double before = border(growth);
    smooth_borders(w.surface, w.region, growth);
    EXPECT_LT(border(growth), before);
    EXPECT_EQ(parts(growth), seeds.size());
  }
}

TEST(Grow, SeedsMoveToTheMiddle) {
  const Whole w = whole(test::sheet(11));
  const Growth growth = grow_charts(w.surface, w.region, w.shapes, 1, 1);
  const std::vector<std::uint32_t> corner{0};
  const std::uint32_t middle = middles(w.surface, w.region, w.shapes, growth, corner)[0];
  const Vec3 at = w.shapes.centroid[middle];
  EXPECT_NEAR(at.x, 0.5, 0.1);
  EXPECT_NEAR(at.y, 0.5, 0.1);
}

}  // namespace
}  // namespace wrapatlas
