// Space divided until few triangles are left in each piece: a k-d tree that exists only while it is
// walked. On axes that wrap, a triangle enters once for each image of it that meets the domain.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "validate/triangle_pair.h"
#include "wrapatlas/result.h"

namespace wrapatlas::validate {

/// A triangle of the atlas, in texels.
struct Item {
  Triangle corners;
  std::uint32_t chart = 0;
  std::uint32_t stack = 0;  ///< charts of one stack move as one and share texels
  std::uint32_t group = 0;  ///< items of equal group and image are never compared
  std::uint32_t face = 0;
};

/// The image of an item at corners - (image_x * period.x, image_y * period.y), with a box around
/// it that is never too small.
struct Entry {
  float low_x, low_y, high_x, high_y;
  std::uint32_t item, group;
  std::int32_t image_x, image_y;

  [[nodiscard]] bool same_group(const Entry& other) const {
    return group == other.group && image_x == other.image_x && image_y == other.image_y;
  }
};

struct Space {
  std::span<const Item> items;
  Vec2 period;        ///< texels; 0 on an axis that does not wrap
  double spread = 0;  ///< every triangle counts as grown by this much

  [[nodiscard]] Triangle image(const Entry& entry) const;
};

/// Sees every leaf of its share of the tree. Any two items of which images come closer than twice
/// the spread meet in a leaf, unless `settled` has stopped the division above it.
class Visitor {
 public:
  virtual ~Visitor() = default;
  [[nodiscard]] virtual bool settled(std::span<const Entry> entries) const = 0;
  virtual void leaf(std::span<const Entry> entries, const Box2& region) = 0;
};

/// Walks the tree with several visitors, one per share, in an order of shares that does not depend
/// on the number of threads. O(n log n) for triangles that are not all crowded in one place; O(n)
/// memory. Error input: triangles that span so many repeats that they cannot be listed.
Result<std::vector<std::unique_ptr<Visitor>>> divide(
    const Space& space, int threads, const std::function<std::unique_ptr<Visitor>()>& make_visitor);

}  // namespace wrapatlas::validate
