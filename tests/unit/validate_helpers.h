// Small atlases, and what the judge says of them.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "wrapatlas/validate.h"

namespace wrapatlas {

/// A mesh in the making, in texels of a 64 x 64 atlas unless said otherwise.
struct Builder {
  Mesh mesh;
  double width = 64, height = 64;

  /// A face of its own in space, so that it is a chart of its own.
  void face(const std::vector<Vec2>& texels) {
    const auto depth = static_cast<double>(mesh.face_count());
    std::vector<Vec3> positions;
    for (const Vec2 p : texels) positions.push_back({p.x / 64, p.y / 64, depth});
    face(texels, positions);
  }
  void face(const std::vector<Vec2>& texels, const std::vector<Vec3>& positions) {
    for (std::size_t i = 0; i < texels.size(); ++i) {
      mesh.corner_position.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.corner_texcoord.push_back(static_cast<std::uint32_t>(mesh.texcoords.size()));
      mesh.positions.push_back(positions[i]);
      mesh.texcoords.push_back({texels[i].x / width, texels[i].y / height});
    }
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
  }
  void box(double x, double y, double w, double h) {
    face({{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}});
  }
};

inline CheckOptions options_of(Wrap wrap = Wrap::none, double padding = 0) {
  CheckOptions options;
  options.width = options.height = 64;
  options.wrap = wrap;
  options.padding = padding;
  options.threads = 2;
  return options;
}

inline CheckReport check(const Mesh& atlas, const CheckOptions& options,
                         const Mesh* reference = nullptr) {
  auto report = check_atlas(atlas, reference, options);
  EXPECT_TRUE(report) << (report ? "" : report.error().message());
  return report ? std::move(*report) : CheckReport{};
}

inline std::vector<Violation> kinds(const CheckReport& report) {
  std::vector<Violation> found;
  for (const Finding& finding : report.findings) found.push_back(finding.kind);
  EXPECT_EQ(found.size(), report.violations);
  return found;
}

using Kinds = std::vector<Violation>;

/// Moves the UVs of all corners by a function of texels.
template <typename Map>
Mesh moved(Mesh mesh, const Map& map) {
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    for (std::uint32_t c = mesh.face_begin[f]; c < mesh.face_begin[f + 1]; ++c) {
      Vec2& uv = mesh.texcoords[mesh.corner_texcoord[c]];
      const Vec2 texel = map(f, Vec2{uv.x * 64, uv.y * 64});
      uv = {texel.x / 64, texel.y / 64};
    }
  }
  return mesh;
}

inline Mesh two_charts() {
  Builder b;
  b.face({{0, 0}, {20, 0}, {5, 10}});
  b.face({{30, 0}, {50, 5}, {35, 20}, {30, 20}});
  return b.mesh;
}

}  // namespace wrapatlas
