#include "io/atlas_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace wrapatlas {
namespace {

Error misfit(std::string where, std::string what) {
  return {ErrorKind::check, std::move(where), std::move(what),
          "this atlas was made from another mesh"};
}

bool point_lies_on(const Mesh& mesh, std::uint32_t face, const AtlasMesh& atlas,
                   std::uint32_t cut) {
  if (cut >= atlas.cut_points.size()) return false;
  const AtlasMesh::CutPoint& point = atlas.cut_points[cut];
  if (point.position >= atlas.cut_position_count) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t corner = point.corners[i];
    const bool lies = corner >= mesh.face_begin[face] && corner < mesh.face_begin[face + 1];
    if (!lies && (i == 0 || point.weights[i] != 0)) return false;
  }
  return true;
}

// Charts as far as a writer can see them: texcoords that share a face are of one chart.
class TexcoordSets {
 public:
  explicit TexcoordSets(const AtlasMesh& atlas) : parent_(atlas.texcoords.size()) {
    std::iota(parent_.begin(), parent_.end(), 0U);
    for (std::size_t face = 0; face < atlas.face_count(); ++face) {
      std::uint32_t first = kNone;
      for (std::uint32_t c = atlas.face_begin[face]; c < atlas.face_begin[face + 1]; ++c) {
        const std::uint32_t texcoord = atlas.corner_texcoord[c];
        if (texcoord == kNone) continue;
        if (first == kNone) first = texcoord;
        parent_[find(texcoord)] = find(first);
      }
    }
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

Status check_fit(const Mesh& mesh, const AtlasMesh& atlas) {
  const std::size_t faces = atlas.face_source.size();
  const std::size_t corners = atlas.corner_source.size();
  if (atlas.face_begin.size() != faces + 1 || atlas.face_begin.front() != 0 ||
      atlas.face_begin.back() != corners || atlas.corner_cut.size() != corners ||
      atlas.corner_texcoord.size() != corners) {
    return misfit("atlas", "its arrays differ in length");
  }
  std::uint32_t expected = 0;  // the source face that has to come next
  for (std::size_t face = 0; face < faces; ++face) {
    const std::uint32_t source = atlas.face_source[face];
    const bool goes_on = expected > 0 && source == expected - 1;
    const auto where = [face] { return fmt::format("atlas face {}", face); };
    if (source >= mesh.face_count() || (source != expected && !goes_on)) {
      return misfit(where(), "source faces are missing or out of order");
    }
    if (!goes_on) ++expected;
    const std::uint32_t begin = atlas.face_begin[face], end = atlas.face_begin[face + 1];
    if (end > corners || end < begin + std::uint64_t{3}) {
      return misfit(where(), "it has fewer than three corners");
    }
    if (!atlas.is_cut() && (goes_on || end - begin != mesh.face_size(source))) {
      return misfit(where(), "it is not the source face, and the atlas is not cut");
    }
    for (std::uint32_t c = begin; c < end; ++c) {
      const std::uint32_t corner = atlas.corner_source[c], cut = atlas.corner_cut[c];
      const std::uint32_t texcoord = atlas.corner_texcoord[c];
      const bool texcoord_fits = texcoord == kNone || texcoord < atlas.texcoords.size();
      const bool corner_fits = corner == kNone ? point_lies_on(mesh, source, atlas, cut)
                                               : corner >= mesh.face_begin[source] &&
                                                     corner < mesh.face_begin[source + 1];
      const bool kept = atlas.is_cut() || corner - mesh.face_begin[source] == c - begin;
      if (!texcoord_fits || !corner_fits || !kept) {
        return misfit(where(), "a corner is not one of its source face");
      }
    }
  }
  if (expected != mesh.face_count()) return misfit("atlas", "source faces are missing");
  return Done{};
}

AtlasMesh turn_upside_down(AtlasMesh atlas) {
  for (Vec2& uv : atlas.texcoords) uv.y = 1 - uv.y;
  if (!wraps_v(atlas.wrap) || atlas.pages > 1) return atlas;
  TexcoordSets sets(atlas);
  std::vector<double> lowest(atlas.texcoords.size(), std::numeric_limits<double>::infinity());
  for (std::uint32_t i = 0; i < atlas.texcoords.size(); ++i) {
    double& v = lowest[sets.find(i)];
    v = std::min(v, atlas.texcoords[i].y);
  }
  for (std::uint32_t i = 0; i < atlas.texcoords.size(); ++i) {
    atlas.texcoords[i].y -= std::floor(lowest[sets.find(i)]);
  }
  return atlas;
}

}  // namespace wrapatlas
