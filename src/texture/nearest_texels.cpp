#include "texture/nearest_texels.h"

#include <limits>

namespace wrapatlas {
namespace {

constexpr int kNowhere = std::numeric_limits<int>::max();

/// Goes down all columns at once (or up): how many rows ago something inside was seen.
template <typename Visit>
void count_rows(int width, int height, const TexelMask& inside, bool wraps, bool down,
                Visit&& visit) {
  std::vector<int> since(static_cast<std::size_t>(width), kNowhere);
  for (int round = wraps ? 0 : 1; round < 2; ++round) {
    for (int i = 0; i < height; ++i) {
      const std::size_t row = std::size_t{1} * (down ? i : height - 1 - i) * width;
      for (std::size_t x = 0; x < since.size(); ++x) {
        if (since[x] != kNowhere) ++since[x];
        if (inside[row + x] != 0) since[x] = 0;
        if (round == 1) visit(row + x, since[x]);
      }
    }
  }
}

/// Per texel how many rows below it (above: negative) its column's nearest texel inside is.
std::vector<int> nearest_rows(int width, int height, const TexelMask& inside, bool wraps) {
  std::vector<int> offset(inside.size());
  count_rows(width, height, inside, wraps, true,
             [&](std::size_t texel, int rows) { offset[texel] = rows == kNowhere ? rows : -rows; });
  count_rows(width, height, inside, wraps, false, [&](std::size_t texel, int rows) {
    if (rows == kNowhere) return;
    if (offset[texel] == kNowhere || rows < -offset[texel]) offset[texel] = rows;
  });
  return offset;
}

/// Which column's parabola is lowest at each place of a row.
class Envelope {
 public:
  void add(int x, double height) {
    double from = -std::numeric_limits<double>::infinity();
    while (!sites_.empty()) {
      const Site& last = sites_.back();
      from = 0.5 * ((height - last.height) / (x - last.x) + x + last.x);
      if (from > last.from) break;
      sites_.pop_back();
      from = -std::numeric_limits<double>::infinity();
    }
    sites_.push_back({x, height, from});
  }

  [[nodiscard]] bool empty() const { return sites_.empty(); }

  /// Calls visit(x, column of the lowest) for x from 0.
  template <typename Visit>
  void walk(int width, Visit&& visit) const {
    std::size_t site = 0;
    for (int x = 0; x < width; ++x) {
      while (site + 1 < sites_.size() && sites_[site + 1].from <= x) ++site;
      visit(x, sites_[site].x);
    }
  }

 private:
  struct Site {
    int x;
    double height;  ///< of the parabola at x
    double from;    ///< where it begins to be the lowest
  };
  std::vector<Site> sites_;
};

}  // namespace

NearestTexels::NearestTexels(int width, int height, const TexelMask& inside, Wrap wrap)
    : width_(width),
      wraps_(wraps_u(wrap)),
      offset_(nearest_rows(width, height, inside, wraps_v(wrap))) {}

bool NearestTexels::find_row(int y, std::vector<TexelOffset>& nearest) const {
  const int* offset = offset_.data() + std::size_t{1} * y * width_;
  const auto wrapped = [&](int x) { return x < 0 ? x + width_ : x % width_; };
  Envelope envelope;
  for (int x = wraps_ ? -width_ : 0; x < (wraps_ ? 2 * width_ : width_); ++x) {
    const int rows = offset[wrapped(x)];
    if (rows != kNowhere) envelope.add(x, double(rows) * rows);
  }
  if (envelope.empty()) return false;
  nearest.resize(static_cast<std::size_t>(width_));
  envelope.walk(width_, [&](int x, int from) {
    nearest[static_cast<std::size_t>(x)] = {from - x, offset[wrapped(from)]};
  });
  return true;
}

}  // namespace wrapatlas
