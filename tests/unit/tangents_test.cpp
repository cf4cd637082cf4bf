// Normals and tangents against what a surface itself says they are.
#include "wrapatlas/tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>

#include "mesh/polygon_plane.h"
#include "support/solids.h"

namespace wrapatlas {
namespace {

constexpr double kPi = std::numbers::pi;

/// Gives a mesh one UV per corner.
template <typename Uv>
void set_uvs(Mesh& mesh, Uv&& uv) {
  mesh.texcoords.clear();
  for (std::uint32_t c = 0; c < mesh.corner_count(); ++c) {
    mesh.corner_texcoord[c] = c;
    mesh.texcoords.push_back(uv(c));
  }
}

Vec3 at(const Mesh& mesh, std::uint32_t corner) {
  return mesh.positions[mesh.corner_position[corner]];
}

/// Two triangles over [0, 1]^2 in the plane z = 0.
Mesh square() {
  return test::bare_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
}

Mesh cube() {
  return test::bare_mesh(
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

TEST(SmoothNormals, EndAtHardEdges) {
  const Mesh mesh = cube();
  const CornerVectors hard = smooth_normals(mesh, 0.5);
  const CornerVectors smooth = smooth_normals(mesh);
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const Vec3 normal = unit(polygon_normal(mesh, face));
    for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
      EXPECT_LT(length(hard[c] - normal), 1e-12);
      const Vec3 diagonal = unit(at(mesh, c) - Vec3{0.5, 0.5, 0.5});
      EXPECT_LT(length(smooth[c] - diagonal), 1e-12);
    }
  }
  // 90 degrees is not more than 90 degrees.
  EXPECT_LT(length(smooth_normals(mesh, kPi / 2 + 1e-9)[0] - smooth[0]), 1e-12);
}

/// Two quads that meet in the edge from 0 to 2, where 1 is, with a triangle of no area in between.
Mesh quads_beside_a_sliver(const Vec3& left, const Vec3& right) {
  return test::bare_mesh(
      {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, left, left + Vec3{0, 2, 0}, right, right + Vec3{0, 2, 0}},
      {{0, 2, 4, 3}, {0, 1, 2}, {5, 6, 2, 1, 0}});
}

TEST(SmoothNormals, FacesWithoutAreaMakeNoHardEdges) {
  const Mesh bent = quads_beside_a_sliver({-1, 0, 0.1}, {1, 0, 0.1});
  const CornerVectors normals = smooth_normals(bent, 0.5);
  EXPECT_LT(length(normals[0] - normals[11]), 1e-12);  // at point 0
  EXPECT_LT(length(normals[1] - normals[9]), 1e-12);   // at point 2
  EXPECT_LT(length(normals[0] - normals[4]), 1e-12);
  EXPECT_GT(length(normals[4]), 0.5);
  // Nor do they bridge those that there are.
  const Mesh corner = quads_beside_a_sliver({-1, 0, 0}, {0, 0, -1});
  const CornerVectors hard = smooth_normals(corner, 0.5);
  EXPECT_GT(length(hard[0] - hard[11]), 1);
  EXPECT_GT(length(hard[4]), 0.5);
}

TEST(SmoothNormals, AllFacesAtAnEdgeAreCompared) {
  // The first and the third of them lie in a plane, the second stands on it.
  const Mesh mesh = test::bare_mesh({{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {1, 0, 0.1}},
                                    {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
  const CornerVectors normals = smooth_normals(mesh, 0.5);
  EXPECT_LT(length(normals[0] - normals[7]), 1e-12);
  EXPECT_GT(length(normals[0] - normals[3]), 0.5);
}

TEST(SmoothNormals, AreThoseOfASphere) {
  const Mesh mesh = test::ball(32);
  const CornerVectors normals = smooth_normals(mesh);
  for (std::uint32_t c = 0; c < mesh.corner_count(); ++c) {
    EXPECT_GT(dot(normals[c], at(mesh, c)), 0.999);
  }
}

TEST(SmoothNormals, GoOverRepeatedPoints) {
  const Mesh whole = test::torus(8);
  Mesh split = whole;
  split.positions.clear();
  for (std::uint32_t c = 0; c < whole.corner_count(); ++c) {
    split.corner_position[c] = c;
    split.positions.push_back(at(whole, c));
  }
  const CornerVectors a = smooth_normals(whole), b = smooth_normals(split);
  for (std::size_t c = 0; c < a.size(); ++c) EXPECT_LT(length(a[c] - b[c]), 1e-12);
}

TEST(Tangents, AreAlongU) {
  Mesh mesh = square();
  set_uvs(mesh, [&](std::uint32_t c) { return Vec2{at(mesh, c).x, at(mesh, c).y}; });
  const TangentFrames up = tangent_frames(mesh, smooth_normals(mesh), false);
  set_uvs(mesh, [&](std::uint32_t c) { return Vec2{at(mesh, c).x, 1 - at(mesh, c).y}; });
  const TangentFrames down = tangent_frames(mesh, smooth_normals(mesh), true);
  const TangentFrames mirrored = tangent_frames(mesh, smooth_normals(mesh), false);
  for (std::size_t c = 0; c < mesh.corner_count(); ++c) {
    for (const TangentFrames* frames : {&up, &down, &mirrored}) {
      EXPECT_LT(length(frames->tangent[c] - Vec3{1, 0, 0}), 1e-12);
    }
    EXPECT_EQ(up.sign[c], 1);
    EXPECT_EQ(down.sign[c], 1);
    EXPECT_EQ(mirrored.sign[c], -1);
  }
}

TEST(Tangents, FollowTheParametersOfATorus) {
  constexpr std::uint32_t kN = 48;
  Mesh mesh = test::torus(kN);
  set_uvs(mesh, [&](std::uint32_t c) {  // of the angle around the axis; continued over the seam
    const Vec3 p = at(mesh, c), first = at(mesh, c - c % 3);
    const auto turns = [](const Vec3& q) { return std::atan2(q.y, q.x) / (2 * kPi); };
    const auto across = [](const Vec3& q) {
      return std::atan2(q.z, std::hypot(q.x, q.y) - 1) / (2 * kPi);
    };
    const auto near = [](double value, double other) { return value - std::round(value - other); };
    return Vec2{near(turns(p), turns(first)), near(across(p), across(first))};
  });
  const TangentFrames frames = tangent_frames(mesh, smooth_normals(mesh), false);
  for (std::uint32_t c = 0; c < mesh.corner_count(); ++c) {
    const Vec3 p = at(mesh, c);
    EXPECT_GT(dot(frames.tangent[c], unit(Vec3{-p.y, p.x, 0})), 0.999) << c;
    EXPECT_NEAR(dot(frames.tangent[c], frames.normal[c]), 0, 1e-12);
    EXPECT_NEAR(length(frames.tangent[c]), 1, 1e-12);
    EXPECT_EQ(frames.sign[c], 1);
  }
}

TEST(Tangents, MirroredNeighboursShareNone) {
  Mesh mesh = square();
  set_uvs(mesh, [&](std::uint32_t c) {  // the second triangle is the first one's mirror image
    const Vec3 p = at(mesh, c);
    return c < 3 ? Vec2{p.x, p.y} : Vec2{p.y, p.x};
  });
  const TangentFrames frames = tangent_frames(mesh, smooth_normals(mesh), false);
  for (std::uint32_t c = 0; c < 6; ++c) {
    EXPECT_EQ(frames.sign[c], c < 3 ? 1 : -1);
    EXPECT_LT(length(frames.tangent[c] - (c < 3 ? Vec3{1, 0, 0} : Vec3{0, 1, 0})), 1e-12);
  }
}

TEST(Tangents, FacesWithoutADirectionTakeTheirNeighbours) {
  Mesh mesh = square();
  set_uvs(mesh, [&](std::uint32_t c) {  // of the second triangle the UVs lie on a line
    const Vec3 p = at(mesh, c);
    return c < 5 ? Vec2{p.x, p.y} : Vec2{0.5, 0.5};
  });
  const TangentFrames frames = tangent_frames(mesh, smooth_normals(mesh), false);
  for (std::uint32_t c = 0; c < 5; ++c) {
    EXPECT_LT(length(frames.tangent[c] - Vec3{1, 0, 0}), 1e-12);
  }
  EXPECT_NEAR(dot(frames.tangent[5], frames.normal[5]), 0, 1e-12);
  EXPECT_NEAR(length(frames.tangent[5]), 1, 1e-12);
}

/// Corners of triangles as Blender, and so MikkTSpace's own code, gives them tangents.
TEST(Tangents, AreThoseOfMikkTSpace) {
  std::ifstream file(WRAPATLAS_SOURCE_DIR "/tests/unit/tangents_of_blender.txt");
  Mesh mesh;
  CornerVectors normals, tangents;
  std::vector<double> signs;
  std::string line;
  while (std::getline(file, line)) {
    if (line.starts_with('#')) continue;
    std::istringstream words(line);
    Vec3 p, n, t;
    Vec2 uv;
    double sign = 0;
    words >> p.x >> p.y >> p.z >> uv.x >> uv.y >> n.x >> n.y >> n.z >> t.x >> t.y >> t.z >> sign;
    ASSERT_TRUE(words) << line;
    mesh.corner_position.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.corner_texcoord.push_back(static_cast<std::uint32_t>(mesh.texcoords.size()));
    mesh.positions.push_back(p);
    mesh.texcoords.push_back(uv);
    normals.push_back(n);
    tangents.push_back(t);
    signs.push_back(sign);
    if (mesh.positions.size() % 3 == 0) {
      mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    }
  }
  ASSERT_EQ(mesh.face_count(), 72U);
  const TangentFrames frames = tangent_frames(mesh, normals, false);
  for (std::size_t c = 0; c < tangents.size(); ++c) {
    EXPECT_LT(length(frames.tangent[c] - tangents[c]), 1e-4) << "corner " << c;
    EXPECT_EQ(double(frames.sign[c]), signs[c]) << "corner " << c;
  }
  // The normals are Blender's, and ours.
  const CornerVectors ours = smooth_normals(mesh);
  for (std::size_t c = 0; c < ours.size(); ++c) {
    EXPECT_LT(length(ours[c] - normals[c]), 1e-4) << "corner " << c;
  }
}

TEST(Tangents, AreThereWithoutUvs) {
  const Mesh mesh = test::ball(6);
  const TangentFrames frames = tangent_frames(mesh, smooth_normals(mesh), false);
  for (std::size_t c = 0; c < mesh.corner_count(); ++c) {
    EXPECT_NEAR(length(frames.tangent[c]), 1, 1e-12);
    EXPECT_NEAR(dot(frames.tangent[c], frames.normal[c]), 0, 1e-12);
  }
}

}  // namespace
}  // namespace wrapatlas
