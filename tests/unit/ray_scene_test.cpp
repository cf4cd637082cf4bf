// Rays and nearest points against a look at every triangle.
#include "bake/ray_scene.h"

#include <gtest/gtest.h>

#include <random>

#include "bake/triangle_point.h"
#include "mesh/polygon_plane.h"
#include "support/solids.h"

namespace wrapatlas {
namespace {

double nearest_by_looking(const Mesh& mesh, const Vec3& p) {
  double least = 1e300;
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const Triangle t = triangle_of(mesh, f);
    for (int i = 0; i <= 40; ++i) {
      for (int j = 0; i + j <= 40; ++j) {
        const double a = i / 40.0, b = j / 40.0;
        least = std::min(least, length(point_at(t, {a, b, 1 - a - b}) - p));
      }
    }
  }
  return least;
}

TEST(NearestWeights, AreNotFartherThanAnyPointLookedAt) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const auto vec = [&] { return Vec3{normal(random), normal(random), normal(random)}; };
  for (int i = 0; i < 200; ++i) {
    Mesh mesh = test::bare_mesh({vec(), vec(), vec()}, {{0, 1, 2}});
    if (i % 5 == 0) mesh.positions[2] = 0.5 * (mesh.positions[0] + mesh.positions[1]);  // a line
    const Vec3 p = vec();
    const Triangle t = triangle_of(mesh, 0);
    const std::array<double, 3> weights = nearest_weights(t, p);
    for (const double w : weights) EXPECT_GE(w, -1e-12);
    EXPECT_NEAR(weights[0] + weights[1] + weights[2], 1, 1e-12);
    const double distance = length(point_at(t, weights) - p);
    const double looked = nearest_by_looking(mesh, p);
    EXPECT_LE(distance, looked + 1e-12);
    EXPECT_GE(distance, looked - 0.15);
  }
}

TEST(RayScene, FindsTheNearestPoint) {
  Mesh mesh = test::torus(12);
  for (Vec3& p : mesh.positions) p = 50.0 * p + Vec3{1000, -3000, 20};
  const auto scene = RayScene::build(mesh, 1);
  ASSERT_TRUE(scene);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-2, 2);
  for (int i = 0; i < 100; ++i) {
    const Vec3 p = 50.0 * Vec3{place(random), place(random), place(random)} + Vec3{1000, -3000, 20};
    double least = 1e300;
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
      const Triangle t = triangle_of(mesh, f);
      least = std::min(least, length(point_at(t, nearest_weights(t, p)) - p));
    }
    const auto found = scene->nearest_point(p);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->distance, least, 1e-9 * scene->diagonal());
  }
}

TEST(RayScene, FindsTheFirstHit) {
  const Mesh mesh = test::ball(24);
  const auto scene = RayScene::build(mesh, 1);
  ASSERT_TRUE(scene);
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200; ++i) {
    const Vec3 direction = unit(Vec3{normal(random), normal(random), normal(random)});
    const auto out = scene->first_hit({0, 0, 0}, direction, 10);
    ASSERT_TRUE(out);
    EXPECT_NEAR(out->distance, 1, 0.01);
    const Vec3 there = point_at(triangle_of(mesh, out->triangle), out->weights);
    EXPECT_LT(length(there - out->distance * direction), 1e-5);
    EXPECT_FALSE(scene->first_hit({0, 0, 0}, direction, 0.9));
    EXPECT_TRUE(scene->is_blocked({0, 0, 0}, direction, 10));
    EXPECT_FALSE(scene->is_blocked({0, 0, 0}, direction, 0.9));
    EXPECT_FALSE(scene->is_blocked(3.0 * direction, direction, 10));
  }
}

}  // namespace
}  // namespace wrapatlas
