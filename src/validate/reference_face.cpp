#include "validate/reference_face.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wrapatlas::validate {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();
constexpr double kPositionRounding = 2.4e-7;  // four times a float's half unit, relative

struct OnSegment {
  double t = 0, distance = 0;
};

OnSegment nearest_on_edge(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0;
  return {t, length(a + t * along - p)};
}

/// The same point, stored as floats or as text with a float's digits.
bool same_as_stored(const Vec3& a, const Vec3& b) {
  return static_cast<float>(a.x) == static_cast<float>(b.x) &&
         static_cast<float>(a.y) == static_cast<float>(b.y) &&
         static_cast<float>(a.z) == static_cast<float>(b.z);
}

}  // namespace

Vec3 vector_area(const Mesh& mesh, std::size_t face, const Vec3& origin) {
  Vec3 sum;
  const std::uint32_t begin = mesh.face_begin[face], end = mesh.face_begin[face + 1];
  for (std::uint32_t c = begin; c < end; ++c) {
    const std::uint32_t next = c + 1 == end ? begin : c + 1;
    sum = sum + cross(position_of(mesh, c) - origin, position_of(mesh, next) - origin);
  }
  return 0.5 * sum;
}

ReferenceFace::ReferenceFace(const Mesh& mesh, std::size_t face)
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

bool ReferenceFace::equals(const Mesh& atlas, std::size_t face) const {
  if (atlas.face_size(face) != size_) return false;
  for (std::uint32_t i = 0; i < size_; ++i) {
    if (length(position_of(atlas, atlas.face_begin[face] + i) - at(i)) > rounding_) return false;
  }
  return true;
}

bool ReferenceFace::contains(const Mesh& atlas, std::size_t face) const {
  for (std::uint32_t c = atlas.face_begin[face]; c < atlas.face_begin[face + 1]; ++c) {
    if (!contains(position_of(atlas, c))) return false;
  }
  return true;
}

FaceMatch::Corner ReferenceFace::locate(const Vec3& p) const {
  FaceMatch::Corner corner;
  bool near_a_corner = false, ambiguous = false;
  for (std::uint32_t i = 0; i < size_; ++i) {
    if (length(at(i) - p) > rounding_) continue;
    ambiguous = ambiguous || (near_a_corner && !(uv(i) == corner.uv));
    // A cut can pass that close by a corner: such a point counts as one of the edge.
    corner = {uv(i), 0, corner.original || same_as_stored(at(i), p)};
    near_a_corner = true;
  }
  if (near_a_corner && thin_) ambiguous = ambiguous || elsewhere_too(p, corner.uv);
  if (ambiguous) return {corner.uv, kUnknown, false};
  if (corner.original) {
    if (!thin_) corner.doubt = 0.5 * rounding_ * steepest();  // a cut next to it is stored as it
    return corner;
  }
  double distance = kUnknown;
  const FaceMatch::Corner found = on_outline(p, distance);
  if (thin_) return {found.uv, kUnknown, false};
  return distance > rounding_ ? inside(p) : found;
}

FaceMatch::Corner ReferenceFace::on_outline(const Vec3& p, double& distance) const {
  FaceMatch::Corner found;
  distance = kUnknown;
  for (std::uint32_t i = 0; i < size_; ++i) {
    const std::uint32_t j = (i + 1) % size_;
    const OnSegment on = nearest_on_edge(p, at(i), at(j));
    if (on.distance >= distance) continue;
    distance = on.distance;
    const Vec2 along = uv(j) - uv(i);
    const double long_enough = length(at(j) - at(i));
    found = {uv(i) + on.t * along, 2 * rounding_ * length(along) / long_enough, false};
  }
  if (!thin_) found.doubt += distance * steepest();
  return found;
}

/// The most that UVs can change with the place, in any of the triangles around the first corner.
double ReferenceFace::steepest() const {
  double most = 0;
  for (std::uint32_t i = 1; i + 1 < size_; ++i) {
    const Vec3 b = at(i) - at(0), c = at(i + 1) - at(0);
    const double whole = std::abs(dot(normal_, cross(b, c)));
    const double change = length(uv(i) - uv(0)) * length(c) + length(uv(i + 1) - uv(0)) * length(b);
    if (whole > 0) most = std::max(most, change / whole);
  }
  return most;
}

/// Folded flat, a face can have a corner in the middle of another edge.
bool ReferenceFace::elsewhere_too(const Vec3& p, Vec2 expected) const {
  for (std::uint32_t i = 0; i < size_; ++i) {
    const std::uint32_t j = (i + 1) % size_;
    if (uv(i) == expected || uv(j) == expected) continue;
    if (nearest_on_edge(p, at(i), at(j)).distance <= rounding_) return true;
  }
  return false;
}

/// In a triangle the map is known; in a larger face it depends on how someone cut it up.
FaceMatch::Corner ReferenceFace::inside(const Vec3& p) const {
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
    if (size_ == 3) best.doubt = 2 * rounding_ * steepest();
  }
  return best;
}

bool ReferenceFace::contains(const Vec3& p) const {
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

}  // namespace wrapatlas::validate
