// The nearest of a set of texels, for every texel, in linear time: first within columns, then along
// rows by the lower envelope of parabolas (Felzenszwalb & Huttenlocher, Distance transforms of
// sampled functions, 2012). On an axis that wraps the line is gone along more than once.
#include <algorithm>
#include <cmath>
#include <limits>

#include "wrapatlas/texture.h"

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
             [&](std::size_t texel, int rows) { offset[texel] = rows; });
  count_rows(width, height, inside, wraps, false, [&](std::size_t texel, int rows) {
    if (offset[texel] == kNowhere || rows < offset[texel]) {
      offset[texel] = rows;
    } else {
      offset[texel] = -offset[texel];
    }
  });
  return offset;
}

/// Which column's parabola is lowest at each place of a row.
class Envelope {
 public:
  Envelope(int width, bool wraps) : width_(width), wraps_(wraps) {}

  /// column[x]: the nearest column by the squares of distances; unwrapped, so it may lie outside
  /// the row. false: there is none.
  bool find(const int* offset, std::vector<int>& column) {
    sites_.clear();
    for (int x = wraps_ ? -width_ : 0; x < (wraps_ ? 2 * width_ : width_); ++x) {
      const int rows = offset[wrapped(x)];
      if (rows != kNowhere) add(x, double(rows) * rows);
    }
    if (sites_.empty()) return false;
    std::size_t site = 0;
    for (int x = 0; x < width_; ++x) {
      while (site + 1 < sites_.size() && sites_[site + 1].from <= x) ++site;
      column[static_cast<std::size_t>(x)] = sites_[site].x;
    }
    return true;
  }

  [[nodiscard]] int wrapped(int x) const { return x < 0 ? x + width_ : x % width_; }

 private:
  struct Site {
    int x;
    double height;  ///< of the parabola at x
    double from;    ///< where it begins to be the lowest
  };

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

  int width_;
  bool wraps_;
  std::vector<Site> sites_;
};

}  // namespace

void dilate(Texture& texture, const TexelMask& inside, Wrap wrap) {
  const int width = texture.width, height = texture.height;
  const std::vector<int> offset = nearest_rows(width, height, inside, wraps_v(wrap));
  Envelope envelope(width, wraps_u(wrap));
  std::vector<int> column(static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    const int* row = offset.data() + std::size_t{1} * y * width;
    if (!envelope.find(row, column)) continue;
    for (int x = 0; x < width; ++x) {
      if (inside[std::size_t{1} * y * width + static_cast<std::size_t>(x)] != 0) continue;
      const int from_x = envelope.wrapped(column[static_cast<std::size_t>(x)]);
      const int from_y = (y + row[from_x] + height) % height;
      std::copy_n(texture.at(from_x, from_y), texture.channels, texture.at(x, y));
    }
  }
}

}  // namespace wrapatlas
