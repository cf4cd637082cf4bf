#include "validate/reference_face.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "validate/stored.h"

namespace wrapatlas::validate {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();
constexpr double kOnEdge = 1e-9;                 // of an edge
constexpr double kBeside = 1.0 / 32;             // of an edge
constexpr double kArithmetic = 1e-15;            // relative, of a place computed between others
constexpr std::uint32_t kMostTriangleEnds = 16;  // beyond, what lies in their box is on the face
constexpr std::uint32_t kMostDiagonalEnds = 64;  // beyond, places on diagonals are not looked for

struct OnSegment {
  double t = 0, distance = 0;
};

OnSegment nearest_on_edge(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0;
  return {t, length(a + t * along - p)};
}

/// Inside the prism that stands on the triangle, and no higher than `height`.
bool over_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, double height) {
  const Vec3 normal = cross(b - a, c - a);
  const double square = dot(normal, normal);
  return square > 0 && std::abs(dot(normal, p - a)) <= height * std::sqrt(square) &&
         dot(normal, cross(b - a, p - a)) >= 0 && dot(normal, cross(c - b, p - b)) >= 0 &&
         dot(normal, cross(a - c, p - c)) >= 0;
}

/// The same point, stored as floats or as text with a float's digits.
bool same_as_stored(const Vec3& a, const Vec3& b) {
  return static_cast<float>(a.x) == static_cast<float>(b.x) &&
         static_cast<float>(a.y) == static_cast<float>(b.y) &&
         static_cast<float>(a.z) == static_cast<float>(b.z);
}

/// From the end, where writers put new points: the first of those tells.
bool all_floats(const Mesh& mesh, Stored& stored) {
  return std::all_of(mesh.positions.rbegin(), mesh.positions.rend(), [&](const Vec3& p) {
    return stored.as_floats(p.x) && stored.as_floats(p.y) && stored.as_floats(p.z);
  });
}

/// Is every vertex of the reference's faces a vertex of the atlas, to the last bit?
bool has_vertices_of(const Mesh& atlas, const Mesh& reference) {
  std::vector<Vec3> all = atlas.positions;
  all.insert(all.end(), reference.positions.begin(), reference.positions.end());
  const std::vector<std::uint32_t> first = weld_positions(all);
  return std::all_of(reference.corner_position.begin(), reference.corner_position.end(),
                     [&](std::uint32_t position) {
                       return first[atlas.positions.size() + position] < atlas.positions.size();
                     });
}

}  // namespace

PositionStore positions_of(const Mesh& atlas, const Mesh& reference) {
  if (atlas.positions == reference.positions) return {0, true};
  Stored stored;
  if (all_floats(atlas, stored)) return {stored.float_error(), false};
  if (has_vertices_of(atlas, reference)) return {0, true};
  return {kFloatHalfUnit, false};  // some text
}

Vec3 vector_area(const Mesh& mesh, std::size_t face, const Vec3& origin) {
  Vec3 sum;
  const std::uint32_t begin = mesh.face_begin[face], end = mesh.face_begin[face + 1];
  for (std::uint32_t c = begin; c < end; ++c) {
    const std::uint32_t next = c + 1 == end ? begin : c + 1;
    sum = sum + cross(position_of(mesh, c) - origin, position_of(mesh, next) - origin);
  }
  return 0.5 * sum;
}

ReferenceFace::ReferenceFace(const Mesh& mesh, std::size_t face, PositionStore store)
    : mesh_(mesh), store_(store), begin_(mesh.face_begin[face]), size_(mesh.face_size(face)) {
  Vec3 largest;
  double perimeter = 0;
  low_ = high_ = at(0);
  for (std::uint32_t i = 0; i < size_; ++i) {
    const Vec3 p = at(i);
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
    high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y), std::max(high_.z, p.z)};
    perimeter += length(at((i + 1) % size_) - p);
  }
  const auto farther = [](double a, double b) { return std::max(std::abs(a), std::abs(b)); };
  largest = {farther(low_.x, high_.x), farther(low_.y, high_.y), farther(low_.z, high_.z)};
  rounding_ = (store.relative + kArithmetic) * length(largest);
  area_ = vector_area(mesh, face, at(0));
  area_rounding_ = 2 * perimeter * rounding_;
  thin_ = length(area_) <= 8 * area_rounding_;
  if (thin_) return;
  normal_ = (1 / length(area_)) * area_;
  flat_convex_ = true;
  for (std::uint32_t i = 0; i < size_; ++i) {
    const Vec3 a = at(i), b = at((i + 1) % size_), c = at((i + 2) % size_);
    bulge_ = std::max(bulge_, std::abs(dot(normal_, a - at(0))));
    if (dot(normal_, cross(b - a, c - b)) < 0) flat_convex_ = false;
  }
  flat_convex_ = flat_convex_ && bulge_ <= rounding_;
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

bool ReferenceFace::is_corner(const Vec3& p, std::uint32_t i) const {
  return store_.exact ? p == at(i) : same_as_stored(at(i), p);
}

FaceMatch::Corner ReferenceFace::locate(const Vec3& p) const {
  FaceMatch::Corner corner;
  bool near_a_corner = false, ambiguous = false;
  std::uint32_t nearest = 0;
  for (std::uint32_t i = 0; i < size_; ++i) {
    if (length(at(i) - p) > rounding_) continue;
    ambiguous = ambiguous || (near_a_corner && !(uv(i) == corner.uv));
    // A cut can pass that close by a corner: such a point counts as one of the edge.
    corner = {uv(i), 0, corner.original || is_corner(p, i)};
    near_a_corner = true;
    nearest = i;
  }
  // A cut next to a corner may be stored as the corner.
  if (near_a_corner && !ambiguous) {
    corner.doubt = thin_ ? doubt_beside(nearest) : 0.5 * rounding_ * steepest();
    ambiguous = std::isinf(corner.doubt) || elsewhere_too(p, corner);
  }
  if (ambiguous) return {corner.uv, kUnknown, false};
  if (corner.original) return corner;
  double distance = kUnknown;
  const FaceMatch::Corner found = on_outline(p, distance);
  if (thin_) return {found.uv, kUnknown, false};
  if (distance > rounding_) return inside(p);
  return elsewhere_too(p, found) ? FaceMatch::Corner{found.uv, kUnknown, false} : found;
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

/// How far in the texture a place may be from a corner that it cannot be told from in space, in a
/// face without area there. Unknown where other corners are not clearly elsewhere.
double ReferenceFace::doubt_beside(std::uint32_t corner) const {
  double most = 0;
  for (std::uint32_t i = 0; i < size_; ++i) {
    if (i == corner || uv(i) == uv(corner)) continue;
    const double reach = 2 * rounding_ / length(at(i) - at(corner));
    if (!(reach < kBeside)) return kUnknown;
    most = std::max(most, reach * length(uv(i) - uv(corner)));
  }
  return most;
}

/// A face can come back to the same place with other UVs: where it is folded, or where corners
/// coincide, and then also by the diagonals along which someone cut it up.
bool ReferenceFace::elsewhere_too(const Vec3& p, const FaceMatch::Corner& found) const {
  for (std::uint32_t i = 0; i < size_; ++i) {
    if (elsewhere_too(p, found, i, (i + 1) % size_)) return true;
  }
  if (size_ > kMostDiagonalEnds) return false;
  for (std::uint32_t i = 0; i < size_; ++i) {
    for (std::uint32_t j = i + 2; j < size_; ++j) {
      if (elsewhere_too(p, found, i, j)) return true;
    }
  }
  return false;
}

bool ReferenceFace::elsewhere_too(const Vec3& p, const FaceMatch::Corner& found, std::uint32_t i,
                                  std::uint32_t j) const {
  const OnSegment on = nearest_on_edge(p, at(i), at(j));
  if (on.distance > rounding_) return false;
  const double long_enough = length(at(j) - at(i));
  if (long_enough == 0) return !(uv(i) == found.uv && uv(j) == found.uv);
  const Vec2 along = uv(j) - uv(i);
  const double doubt = found.doubt + 2 * rounding_ * length(along) / long_enough;
  return length(uv(i) + on.t * along - found.uv) > doubt + kOnEdge * length(along);
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

/// Where the surface of a face that is not flat or not convex lies depends on how someone cut it
/// up.
bool ReferenceFace::on_some_triangle(const Vec3& p) const {
  const auto within = [&](double low, double x, double high) {
    return low - rounding_ <= x && x <= high + rounding_;
  };
  if (!within(low_.x, p.x, high_.x) || !within(low_.y, p.y, high_.y) ||
      !within(low_.z, p.z, high_.z)) {
    return false;
  }
  if (size_ > kMostTriangleEnds) return true;
  for (std::uint32_t i = 0; i < size_; ++i) {
    for (std::uint32_t j = i + 1; j < size_; ++j) {
      if (nearest_on_edge(p, at(i), at(j)).distance <= rounding_) return true;
      for (std::uint32_t k = j + 1; k < size_; ++k) {
        if (over_triangle(p, at(i), at(j), at(k), rounding_)) return true;
      }
    }
  }
  return false;
}

bool ReferenceFace::contains(const Vec3& p) const {
  if (thin_ || (size_ > 3 && !flat_convex_)) return on_some_triangle(p);
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
  return odd && std::abs(dot(normal_, p - at(0))) <= 2 * bulge_ + rounding_;
}

}  // namespace wrapatlas::validate
