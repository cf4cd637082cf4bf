// The nearest of a set of texels, for every texel, in linear time: first within columns, then along
// rows by the lower envelope of parabolas (Felzenszwalb & Huttenlocher, Distance transforms of
// sampled functions, 2012). On an axis that wraps the line is gone along more than once.
#include <algorithm>
#include <cmath>
#include <limits>

#include "threads/parallel.h"
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

  /// Calls visit(x, column) for all x of a row: the nearest column by the squares of distances. Not
  /// if there is none.
  template <typename Visit>
  void find(const int* offset, Visit&& visit) {
    sites_.clear();
    for (int x = wraps_ ? -width_ : 0; x < (wraps_ ? 2 * width_ : width_); ++x) {
      const int rows = offset[wrapped(x)];
      if (rows != kNowhere) add(x, double(rows) * rows);
    }
    if (sites_.empty()) return;
    std::size_t site = 0;
    for (int x = 0; x < width_; ++x) {
      while (site + 1 < sites_.size() && sites_[site + 1].from <= x) ++site;
      visit(x, wrapped(sites_[site].x));
    }
  }

 private:
  struct Site {
    int x;
    double height;  ///< of the parabola at x
    double from;    ///< where it begins to be the lowest
  };

  [[nodiscard]] int wrapped(int x) const { return x < 0 ? x + width_ : x % width_; }

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

void fill_row(Texture& texture, const TexelMask& inside, const std::vector<int>& offset,
              Envelope& envelope, int y) {
  const std::size_t row = std::size_t{1} * y * texture.width;
  envelope.find(offset.data() + row, [&](int x, int from_x) {
    if (inside[row + static_cast<std::size_t>(x)] != 0) return;
    const int rows = offset[row + static_cast<std::size_t>(from_x)];
    const int from_y = (y + rows + texture.height) % texture.height;
    std::copy_n(texture.at(from_x, from_y), texture.channels, texture.at(x, y));
  });
}

}  // namespace

void dilate(Texture& texture, const TexelMask& inside, Wrap wrap, int threads) {
  const int width = texture.width, height = texture.height;
  const std::vector<int> offset = nearest_rows(width, height, inside, wraps_v(wrap));
  constexpr int kBand = 64;  // rows that share an envelope's memory
  parallel_for(static_cast<std::size_t>((height + kBand - 1) / kBand), thread_count(threads),
               [&](std::size_t band) {
                 Envelope envelope(width, wraps_u(wrap));
                 const int begin = static_cast<int>(band) * kBand;
                 for (int y = begin; y < std::min(height, begin + kBand); ++y) {
                   fill_row(texture, inside, offset, envelope, y);
                 }
               });
}

}  // namespace wrapatlas
