#include "validate/face_match.h"

#include <fmt/format.h>

#include <optional>

#include "validate/connectivity.h"

namespace wrapatlas::validate {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();
constexpr double kPositionRounding = 2.4e-7;  // four times a float's half unit, relative

Vec3 position(const Mesh& mesh, std::uint32_t corner) {
  return mesh.positions[mesh.corner_position[corner]];
}

Vec2 texcoord(const Mesh& mesh, std::uint32_t corner) {
  const std::uint32_t index = mesh.corner_texcoord[corner];
  return index == kNone ? Vec2{} : mesh.texcoords[index];
}

/// Half the sum of the edges' moments: it adds up over the pieces of any tiling, flat or not.
Vec3 vector_area(const Mesh& mesh, std::size_t face, const Vec3& origin) {
  Vec3 sum;
  const std::uint32_t begin = mesh.face_begin[face], end = mesh.face_begin[face + 1];
  for (std::uint32_t c = begin; c < end; ++c) {
    const std::uint32_t next = c + 1 == end ? begin : c + 1;
    sum = sum + cross(position(mesh, c) - origin, position(mesh, next) - origin);
  }
  return 0.5 * sum;
}

double texcoord_area(const Mesh& mesh, std::size_t face) {
  double sum = 0;
  const std::uint32_t begin = mesh.face_begin[face], end = mesh.face_begin[face + 1];
  const Vec2 origin = texcoord(mesh, begin);
  for (std::uint32_t c = begin; c < end; ++c) {
    const std::uint32_t next = c + 1 == end ? begin : c + 1;
    sum += cross(texcoord(mesh, c) - origin, texcoord(mesh, next) - origin);
  }
  return 0.5 * sum;
}

struct OnSegment {
  double t = 0, distance = 0;
};

OnSegment nearest_on_edge(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0;
  return {t, length(a + t * along - p)};
}

/// A face of the reference, ready to be asked about points of the atlas.
class Face {
 public:
  Face(const Mesh& mesh, std::size_t face)
      : mesh_(mesh), begin_(mesh.face_begin[face]), size_(mesh.face_size(face)) {
    double largest = 0, perimeter = 0;
    for (std::uint32_t i = 0; i < size_; ++i) {
      const Vec3 p = at(i);
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      perimeter += length(at((i + 1) % size_) - p);
    }
    rounding_ = kPositionRounding * largest;
    area_ = vector_area(mesh, face, at(0));
    area_rounding_ = 2 * perimeter * rounding_;
    thin_ = length(area_) <= 8 * area_rounding_;
    if (thin_) return;
    normal_ = (1 / length(area_)) * area_;
    for (std::uint32_t i = 1; i < size_; ++i) {
      bulge_ = std::max(bulge_, std::abs(dot(normal_, at(i) - at(0))));
    }
  }

  [[nodiscard]] bool thin() const { return thin_; }
  [[nodiscard]] Vec3 origin() const { return at(0); }
  [[nodiscard]] bool filled_by(const Vec3& area) const {
    return length(area - area_) <= area_rounding_;
  }

  /// The share of the face's area that rounding can hide.
  [[nodiscard]] double area_doubt() const { return thin_ ? 0 : area_rounding_ / length(area_); }

  [[nodiscard]] bool counts_as_flat(const Vec3& area) const {
    return length(area) <= area_rounding_;
  }

  [[nodiscard]] bool equals(const Mesh& atlas, std::size_t face) const {
    if (atlas.face_size(face) != size_) return false;
    for (std::uint32_t i = 0; i < size_; ++i) {
      if (length(position(atlas, atlas.face_begin[face] + i) - at(i)) > rounding_) return false;
    }
    return true;
  }

  /// Whether all corners are among those of a face of the atlas.
  [[nodiscard]] bool is_within(const Mesh& atlas, std::size_t face) const {
    for (std::uint32_t i = 0; i < size_; ++i) {
      bool found = false;
      for (std::uint32_t c = atlas.face_begin[face]; c < atlas.face_begin[face + 1]; ++c) {
        found = found || length(position(atlas, c) - at(i)) <= rounding_;
      }
      if (!found) return false;
    }
    return true;
  }

  [[nodiscard]] bool contains(const Mesh& atlas, std::size_t face) const {
    for (std::uint32_t c = atlas.face_begin[face]; c < atlas.face_begin[face + 1]; ++c) {
      if (!contains(position(atlas, c))) return false;
    }
    return true;
  }

  [[nodiscard]] FaceMatch::Corner locate(const Vec3& p) const {
    FaceMatch::Corner found;
    bool ambiguous = false;
    for (std::uint32_t i = 0; i < size_; ++i) {
      if (length(at(i) - p) > rounding_) continue;
      ambiguous = ambiguous || (found.original && !(uv(i) == found.uv));
      found = {uv(i), 0, true};
    }
    if (found.original && thin_) ambiguous = ambiguous || elsewhere_too(p, found.uv);
    if (ambiguous) return {found.uv, kUnknown, false};
    if (found.original) return found;
    double nearest = kUnknown;
    for (std::uint32_t i = 0; i < size_; ++i) {
      const std::uint32_t j = (i + 1) % size_;
      const OnSegment on = nearest_on_edge(p, at(i), at(j));
      if (on.distance >= nearest) continue;
      nearest = on.distance;
      const Vec2 along = uv(j) - uv(i);
      const double long_enough = length(at(j) - at(i));
      found = {uv(i) + on.t * along, 2 * rounding_ * length(along) / long_enough, false};
    }
    if (thin_) return {found.uv, kUnknown, false};
    if (nearest > rounding_) found = inside(p);
    return found;
  }

 private:
  [[nodiscard]] Vec3 at(std::uint32_t i) const { return position(mesh_, begin_ + i); }
  [[nodiscard]] Vec2 uv(std::uint32_t i) const { return texcoord(mesh_, begin_ + i); }

  /// Folded flat, a face can have a corner in the middle of another edge.
  [[nodiscard]] bool elsewhere_too(const Vec3& p, Vec2 expected) const {
    for (std::uint32_t i = 0; i < size_; ++i) {
      const std::uint32_t j = (i + 1) % size_;
      if (uv(i) == expected || uv(j) == expected) continue;
      if (nearest_on_edge(p, at(i), at(j)).distance <= rounding_) return true;
    }
    return false;
  }

  /// In a triangle the map is known; in a larger face it depends on how someone cut it up.
  [[nodiscard]] FaceMatch::Corner inside(const Vec3& p) const {
    FaceMatch::Corner best{uv(0), kUnknown, false};
    double worst_weight = -kUnknown;
    for (std::uint32_t i = 1; i + 1 < size_; ++i) {
      const Vec3 a = at(0), b = at(i), c = at(i + 1);
      const double whole = dot(normal_, cross(b - a, c - a));
      if (whole == 0) continue;
      const double of_b = dot(normal_, cross(p - a, c - a)) / whole;
      const double of_c = dot(normal_, cross(b - a, p - a)) / whole;
      const double least = std::min({of_b, of_c, 1 - of_b - of_c});
      if (least <= worst_weight) continue;
      worst_weight = least;
      const Vec2 along_b = uv(i) - uv(0), along_c = uv(i + 1) - uv(0);
      best.uv = uv(0) + of_b * along_b + of_c * along_c;
      const double gradient =
          (length(along_b) * length(c - a) + length(along_c) * length(b - a)) / std::abs(whole);
      if (size_ == 3) best.doubt = 2 * rounding_ * gradient;
    }
    return best;
  }

  [[nodiscard]] bool contains(const Vec3& p) const {
    bool odd = false;
    // Across the longest axis of the normal the outline is a polygon of the plane.
    const double nx = std::abs(normal_.x), ny = std::abs(normal_.y), nz = std::abs(normal_.z);
    const auto flat = [&](const Vec3& q) {
      if (nx >= ny && nx >= nz) return Vec2{q.y, q.z};
      return ny >= nz ? Vec2{q.z, q.x} : Vec2{q.x, q.y};
    };
    const Vec2 at_p = flat(p);
    for (std::uint32_t i = 0; i < size_; ++i) {
      const Vec3 a = at(i), b = at((i + 1) % size_);
      if (nearest_on_edge(p, a, b).distance <= rounding_) return true;
      const Vec2 fa = flat(a), fb = flat(b);
      if ((fa.y > at_p.y) != (fb.y > at_p.y) &&
          at_p.x < fa.x + (at_p.y - fa.y) / (fb.y - fa.y) * (fb.x - fa.x)) {
        odd = !odd;
      }
    }
    return odd && !thin_ && std::abs(dot(normal_, p - at(0))) <= 2 * bulge_ + rounding_;
  }

  const Mesh& mesh_;
  std::uint32_t begin_, size_;
  double rounding_ = 0, area_rounding_ = 0, bulge_ = 0;
  Vec3 area_, normal_;
  bool thin_ = false;
};

/// Faces in a row from `first` that tile `face`; 0 if they do not.
class Tiling {
 public:
  Tiling(const Mesh& atlas, const Mesh& reference, Vec2 size)
      : atlas_(atlas), reference_(reference), texels_(size.x * size.y) {
    double of_atlas = 0, of_reference = 0;
    for (std::size_t f = 0; f < atlas.face_count(); ++f) {
      if (has_texcoords(atlas, f)) of_atlas += std::abs(texcoord_area(atlas, f));
    }
    for (std::size_t f = 0; f < reference.face_count(); ++f) {
      if (has_texcoords(reference, f)) of_reference += std::abs(texcoord_area(reference, f));
    }
    area_ratio_ = of_reference > 0 ? of_atlas / of_reference : 0;
  }

  std::size_t count(const Face& face, std::size_t reference_face, std::size_t first) const {
    if (first >= atlas_.face_count()) return 0;
    if (face.equals(atlas_, first)) return 1;
    const std::size_t tiles =
        face.thin() ? tiles_by_texcoords(face, reference_face, first) : tiles_in_space(face, first);
    return tiles == 0 ? 0 : tiles + flat_remainders(face, reference_face, first + tiles);
  }

 private:
  std::size_t tiles_in_space(const Face& face, std::size_t first) const {
    Vec3 area;
    for (std::size_t f = first; f < atlas_.face_count() && face.contains(atlas_, f); ++f) {
      area = area + vector_area(atlas_, f, face.origin());
      if (face.filled_by(area)) return f + 1 - first;
    }
    return 0;
  }

  /// For a face without area in space: until its area in the texture is used up.
  std::size_t tiles_by_texcoords(const Face& face, std::size_t reference_face,
                                 std::size_t first) const {
    if (!face.contains(atlas_, first)) return 0;
    const double whole = area_ratio_ * std::abs(texcoord_area(reference_, reference_face));
    if (whole * texels_ < 1e-3 || !has_texcoords(reference_, reference_face)) return 1;
    double used = 0;
    for (std::size_t f = first; f < atlas_.face_count() && face.contains(atlas_, f); ++f) {
      used += std::abs(texcoord_area(atlas_, f));
      if (used > 0.99 * whole) return used < 1.01 * whole ? f + 1 - first : 0;
    }
    return 0;
  }

  /// Tiles too small to be missed that follow when the face is full: of the tip of a face that
  /// just crosses the border, say. What holds the whole next face of the reference is none.
  std::size_t flat_remainders(const Face& face, std::size_t reference_face,
                              std::size_t first) const {
    const double whole = area_ratio_ * std::abs(texcoord_area(reference_, reference_face));
    const double small = 2 * face.area_doubt() * whole + 1e-3 / texels_;
    std::optional<Face> next;
    if (reference_face + 1 < reference_.face_count()) next.emplace(reference_, reference_face + 1);
    std::size_t f = first;
    while (f < atlas_.face_count() && face.contains(atlas_, f) &&
           face.counts_as_flat(vector_area(atlas_, f, face.origin())) &&
           std::abs(texcoord_area(atlas_, f)) <= small && !(next && next->is_within(atlas_, f))) {
      ++f;
    }
    return f - first;
  }

  const Mesh& atlas_;
  const Mesh& reference_;
  double texels_, area_ratio_ = 0;
};

}  // namespace

Result<FaceMatch> match_faces(const Mesh& atlas, const Mesh& reference, Vec2 atlas_size) {
  FaceMatch match;
  match.source.assign(atlas.face_count(), kNone);
  match.corners.resize(atlas.corner_count());
  const Tiling tiling(atlas, reference, atlas_size);
  std::size_t next = 0;
  for (std::uint32_t f = 0; f < reference.face_count(); ++f) {
    const Face face(reference, f);
    const std::size_t tiles = tiling.count(face, f, next);
    if (tiles == 0) match.missing.push_back(f);
    const bool whole = tiles == 1 && face.equals(atlas, next);
    for (std::size_t end = next + tiles; next < end; ++next) {
      match.source[next] = f;
      for (std::uint32_t c = atlas.face_begin[next]; c < atlas.face_begin[next + 1]; ++c) {
        const std::uint32_t same = reference.face_begin[f] + (c - atlas.face_begin[next]);
        match.corners[c] = whole ? FaceMatch::Corner{texcoord(reference, same), 0, true}
                                 : face.locate(position(atlas, c));
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

}  // namespace wrapatlas::validate
