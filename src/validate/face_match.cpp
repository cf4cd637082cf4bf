#include "validate/face_match.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "validate/connectivity.h"
#include "validate/face_order.h"
#include "validate/reference_face.h"

namespace wrapatlas::validate {
namespace {

constexpr double kSameTexcoord = 1e-6;   // of the atlas's side
constexpr double kSliver = 1e-5;         // of a face's area in the texture
constexpr std::size_t kMostUnsure = 64;  // slivers in a row; keeps the time linear

double texcoord_area(const Mesh& mesh, std::size_t face) {
  double sum = 0;
  const std::uint32_t begin = mesh.face_begin[face], end = mesh.face_begin[face + 1];
  const Vec2 origin = texcoord_of(mesh, begin);
  for (std::uint32_t c = begin; c < end; ++c) {
    const std::uint32_t next = c + 1 == end ? begin : c + 1;
    sum += cross(texcoord_of(mesh, c) - origin, texcoord_of(mesh, next) - origin);
  }
  return 0.5 * sum;
}

/// A cut leaves its two sides a whole number of periods apart.
bool same_up_to_periods(Vec2 a, Vec2 b) {
  const Vec2 d = a - b;
  return std::abs(d.x - std::round(d.x)) <= kSameTexcoord &&
         std::abs(d.y - std::round(d.y)) <= kSameTexcoord;
}

/// Two ways to sum the areas of faces. The pieces of a face that crosses itself wind both ways and
/// sum to its own area with their signs only; where charts are mirrored, signs cancel too much.
enum class Areas { without_sign, with_sign };

double total_area(const Mesh& mesh, Areas areas) {
  double sum = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    if (!has_texcoords(mesh, f)) continue;
    const double area = texcoord_area(mesh, f);
    sum += areas == Areas::with_sign ? area : std::abs(area);
  }
  return std::abs(sum);
}

/// How many faces in a row, from a first one on, are the pieces of a face of the reference.
class Tiling {
 public:
  Tiling(const Mesh& atlas, const Mesh& reference, PositionStore store, Vec2 size, Areas areas)
      : atlas_(atlas), reference_(reference), store_(store), texels_(size.x * size.y) {
    const double of_reference = total_area(reference, areas);
    area_ratio_ = of_reference > 0 ? total_area(atlas, areas) / of_reference : 0;
  }

  /// 0 if there is no tiling.
  [[nodiscard]] std::size_t count(std::size_t reference_face, std::size_t first) const {
    const ReferenceFace face(reference_, reference_face, store_);
    const std::size_t tiles = fill(face, reference_face, first);
    if (tiles == 0) return 0;
    return tiles + slivers(face, reference_face, first, tiles);
  }

 private:
  /// The fewest pieces whose area is that of the face, to within rounding.
  std::size_t fill(const ReferenceFace& face, std::size_t reference_face, std::size_t first) const {
    if (first >= atlas_.face_count()) return 0;
    const bool whole = face.equals(atlas_, first);
    if (!face.thin()) return whole ? 1 : fill_in_space(face, reference_face, first);
    // So coarse positions may make it equal to a piece of it, or of another face.
    const std::size_t tiles = fill_by_texcoords(face, reference_face, first);
    return tiles == 0 && whole ? 1 : tiles;
  }

  std::size_t fill_in_space(const ReferenceFace& face, std::size_t reference_face,
                            std::size_t first) const {
    Vec3 area;
    std::size_t f = first, tiles = 0;
    for (; f < atlas_.face_count() && face.contains(atlas_, f) && tiles == 0; ++f) {
      area = area + vector_area(atlas_, f, face.origin());
      if (face.filled_by(area)) tiles = f + 1 - first;
    }
    if (tiles == 0 || f == atlas_.face_count() || !face.contains(atlas_, f)) return tiles;
    // Of a face that crosses itself, pieces can undo each other's areas.
    std::optional<ReferenceFace> next;
    if (reference_face + 1 < reference_.face_count()) {
      next.emplace(reference_, reference_face + 1, store_);
    }
    bool undone = false;
    for (; f < atlas_.face_count() && face.contains(atlas_, f); ++f) {
      if (next && next->contains(atlas_, f)) break;
      const Vec3 own = vector_area(atlas_, f, face.origin());
      area = area + own;
      undone = undone || !face.counts_as_flat(own);
      if (undone && face.filled_by(area)) tiles = f + 1 - first;
    }
    return tiles;
  }

  /// For a face without area in space: until its area in the texture is used up.
  std::size_t fill_by_texcoords(const ReferenceFace& face, std::size_t reference_face,
                                std::size_t first) const {
    if (!face.contains(atlas_, first)) return 0;
    const double whole = share_of(reference_face);
    if (whole == 0) return 1;
    double used = 0, off = whole;
    std::size_t tiles = 0;
    for (std::size_t f = first; f < atlas_.face_count() && face.contains(atlas_, f); ++f) {
      used += texcoord_area(atlas_, f);
      const double now_off = std::abs(std::abs(used) - whole);
      if (tiles > 0 && now_off >= off) break;
      off = now_off;
      if (off < 0.01 * whole) tiles = f + 1 - first;
    }
    return tiles;
  }

  /// The area in the atlas that a face should have, as a share of it; 0 if that is none to speak
  /// of.
  [[nodiscard]] double share_of(std::size_t reference_face) const {
    if (!has_texcoords(reference_, reference_face)) return 0;
    const double share = area_ratio_ * std::abs(texcoord_area(reference_, reference_face));
    return share * texels_ < 1e-3 ? 0 : share;
  }

  /// Pieces too thin to add to the area may come when the face is full already. One that lies on
  /// the side shared with the next face could be of either: it is of the face that it was cut off.
  std::size_t slivers(const ReferenceFace& face, std::size_t reference_face, std::size_t first,
                      std::size_t tiles) const {
    if (first + tiles >= atlas_.face_count() || !face.contains(atlas_, first + tiles)) return 0;
    std::optional<ReferenceFace> next;
    if (reference_face + 1 < reference_.face_count()) {
      next.emplace(reference_, reference_face + 1, store_);
    }
    const double share = face.thin() ? share_of(reference_face) : 0;
    Vec3 area;
    for (std::size_t tile = first; tile < first + tiles; ++tile) {
      area = area + vector_area(atlas_, tile, face.origin());
    }
    std::size_t f = first + tiles, sure_end = f;
    for (; f < atlas_.face_count() && face.contains(atlas_, f); ++f) {
      const Vec3 own = vector_area(atlas_, f, face.origin());
      area = area + own;
      if (!face.counts_as_flat(own) || !(face.thin() || face.still_filled_by(area))) break;
      if (share > 0 && std::abs(texcoord_area(atlas_, f)) > kSliver * share) break;
      if (!next || !next->contains(atlas_, f)) {
        sure_end = f + 1;
      } else if (next->equals(atlas_, f) || f - sure_end >= kMostUnsure || !is_cut_off(f, first)) {
        break;
      }
    }
    if (f > sure_end && next->thin()) {  // the next face may itself be no more than a sliver
      for (std::size_t end = f + 1; end-- > sure_end;) {
        if (fill(*next, reference_face + 1, end) > 0) return end - first - tiles;
      }
    }
    return f - first - tiles;
  }

  /// Does the face share an edge that is still open with those before it, from `first` on? With
  /// coarse positions a piece can be a mere line or point: then it shares a corner with them.
  [[nodiscard]] bool is_cut_off(std::size_t face, std::size_t first) const {
    const std::uint32_t begin = atlas_.face_begin[face], end = atlas_.face_begin[face + 1];
    bool collapsed = true;
    for (std::uint32_t c = begin; c < end; ++c) {
      const std::uint32_t next = c + 1 == end ? begin : c + 1;
      if (open_uses(c, next, first, face) > 0) return true;
      collapsed = collapsed && open_uses(c, next, face, face + 1) == 0;
    }
    if (!collapsed) return false;
    for (std::uint32_t c = begin; c < end; ++c) {
      for (std::uint32_t d = atlas_.face_begin[first]; d < begin; ++d) {
        if (same_place(c, d)) return true;
      }
    }
    return false;
  }

  /// How many more pieces have the edge in the other direction than have it in this one.
  [[nodiscard]] int open_uses(std::uint32_t from, std::uint32_t to, std::size_t first,
                              std::size_t end_face) const {
    int open = 0;
    for (std::size_t f = first; f < end_face; ++f) {
      const std::uint32_t begin = atlas_.face_begin[f], end = atlas_.face_begin[f + 1];
      for (std::uint32_t c = begin; c < end; ++c) {
        const std::uint32_t next = c + 1 == end ? begin : c + 1;
        if (same_place(c, to) && same_place(next, from)) ++open;
        if (same_place(c, from) && same_place(next, to)) --open;
      }
    }
    return open;
  }

  [[nodiscard]] bool same_place(std::uint32_t a, std::uint32_t b) const {
    return position_of(atlas_, a) == position_of(atlas_, b) &&
           same_up_to_periods(texcoord_of(atlas_, a), texcoord_of(atlas_, b));
  }

  const Mesh& atlas_;
  const Mesh& reference_;
  PositionStore store_;
  double texels_, area_ratio_ = 0;
};

Result<FaceMatch> match_in_order(const Mesh& atlas, const Mesh& reference, PositionStore store,
                                 Vec2 atlas_size, Areas areas) {
  FaceMatch match;
  match.source.assign(atlas.face_count(), kNone);
  match.corners.resize(atlas.corner_count());
  const Tiling tiling(atlas, reference, store, atlas_size, areas);
  const bool uncut = atlas.face_count() == reference.face_count();
  std::size_t next = 0;
  for (std::uint32_t f = 0; f < reference.face_count(); ++f) {
    const ReferenceFace face(reference, f, store);
    const std::size_t tiles = tiling.count(f, next);
    if (tiles == 0) match.missing.push_back(f);
    const bool whole =
        tiles == 1 && face.equals(atlas, next) && (uncut || store.exact || !face.thin());
    for (std::size_t end = next + tiles; next < end; ++next) {
      match.source[next] = f;
      for (std::uint32_t c = atlas.face_begin[next]; c < atlas.face_begin[next + 1]; ++c) {
        const std::uint32_t same = reference.face_begin[f] + (c - atlas.face_begin[next]);
        match.corners[c] = whole ? FaceMatch::Corner{texcoord_of(reference, same), 0, true}
                                 : face.locate(position_of(atlas, c));
      }
    }
  }
  if (next < atlas.face_count()) {
    return Error{ErrorKind::input, fmt::format("face {} of the atlas", next),
                 "it is no part of the reference's face that is next in order",
                 "compare an atlas with the mesh that it was made from"};
  }
  return match;
}

/// With both meshes' faces object by object.
Result<FaceMatch> match_by_object(const Mesh& atlas, const Mesh& reference, PositionStore store,
                                  Vec2 atlas_size, Areas areas) {
  const std::vector<std::uint32_t> atlas_order = order_by_object(atlas);
  const std::vector<std::uint32_t> reference_order = order_by_object(reference);
  auto sorted = match_in_order(reordered(atlas, atlas_order), reordered(reference, reference_order),
                               store, atlas_size, areas);
  if (!sorted) return sorted.error();
  FaceMatch match;
  match.source.resize(atlas.face_count());
  match.corners.resize(atlas.corner_count());
  auto corner = sorted->corners.begin();
  for (std::size_t i = 0; i < atlas_order.size(); ++i) {
    const std::uint32_t f = atlas_order[i];
    match.source[f] = reference_order[sorted->source[i]];
    const auto end = corner + atlas.face_size(f);
    std::copy(corner, end, match.corners.begin() + atlas.face_begin[f]);
    corner = end;
  }
  for (const std::uint32_t f : sorted->missing) match.missing.push_back(reference_order[f]);
  return match;
}

}  // namespace

Result<FaceMatch> match_faces(const Mesh& atlas, const Mesh& reference, Vec2 atlas_size) {
  const PositionStore store = positions_of(atlas, reference);
  const auto complete = [](const Result<FaceMatch>& match) {
    return match && match->missing.empty();
  };
  auto match = match_in_order(atlas, reference, store, atlas_size, Areas::without_sign);
  for (const Areas areas : {Areas::without_sign, Areas::with_sign}) {
    if (complete(match)) break;
    auto in_order = match_in_order(atlas, reference, store, atlas_size, areas);
    if (complete(in_order)) return in_order;
    auto by_object = match_by_object(atlas, reference, store, atlas_size, areas);
    if (complete(by_object)) return by_object;
  }
  return match;
}

}  // namespace wrapatlas::validate
