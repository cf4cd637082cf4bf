// What padding costs: how much larger all charts of a packing could be where they are. Ours.
//
// Charts that grow by k about their centres, on a page of fixed size, look like charts of fixed
// size on a page that shrinks by k, centres with it. So two charts meet as if one of them went
// straight to the other's centre, by the share 1 - 1 / k of the way, and the first contact of two
// outlines, one of which is translated, is exact: no grid, and no scale that is stepped over.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "pack/first_contact.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {
namespace {

/// A chart as placed.
struct Grown {
  int page = 0;
  Vec2 centre;      ///< of its box, texels; on axes that wrap within the page
  Vec2 half;        ///< of its box's size, texels
  Outline outline;  ///< relative to the centre, texels
};

double wrapped(double position, double period) {
  return position - period * std::floor(position / period);
}

/// None if the chart covers nothing.
std::optional<Grown> grown_chart(const Chart& chart, const Packing& packing, std::size_t index) {
  const Similarity move = packing.transform(index);
  Outline outline;
  for (const OutlineEdge& edge : chart.outline) {
    outline.add(move.apply(chart.points[edge.from]), move.apply(chart.points[edge.to]));
  }
  for (const std::uint32_t triangle : chart.against_grain) {
    const auto& corner = chart.triangles[triangle];
    for (std::size_t i = 0; i < 3; ++i) {
      outline.add(move.apply(chart.points[corner[i]]),
                  move.apply(chart.points[corner[(i + 1) % 3]]));
    }
  }
  if (outline.segments.empty()) return std::nullopt;
  Grown grown;
  grown.page = packing.placements[index].page;
  grown.centre = 0.5 * (outline.box.min + outline.box.max);
  grown.half = 0.5 * outline.box.size();
  for (const OutlineSegment& segment : outline.segments) {
    grown.outline.add(segment.from - grown.centre, segment.to - grown.centre);
  }
  if (wraps_u(packing.wrap)) grown.centre.x = wrapped(grown.centre.x, packing.width);
  if (wraps_v(packing.wrap)) grown.centre.y = wrapped(grown.centre.y, packing.height);
  return grown;
}

/// A chart, or its image across a border that wraps.
struct Image {
  const Grown* chart;
  Vec2 centre;
  bool original;
};

class Growth {
 public:
  Growth(std::span<const Chart> charts, const Packing& packing)
      : packing_(packing), page_{double(packing.width), double(packing.height)} {
    std::vector<double> area(static_cast<std::size_t>(packing.pages), 0);
    for (std::size_t i = 0; i < charts.size(); ++i) {
      area[static_cast<std::size_t>(packing.placements[i].page)] += charts[i].area;
      if (auto grown = grown_chart(charts[i], packing, i)) charts_.push_back(std::move(*grown));
    }
    // Charts that do not overlap cover no more than their page.
    const double most_area = *std::max_element(area.begin(), area.end());
    limit(std::sqrt(page_.x * page_.y / most_area) / packing.scale);
    // A needle may wind around the torus for long.
    constexpr double kLongestInPages = 8;
    for (const Grown& chart : charts_) {
      limit(kLongestInPages * std::min(page_.x, page_.y) /
            (2 * std::max(chart.half.x, chart.half.y)));
    }
  }

  /// The largest factor, at least 1.
  double factor() {
    for (const Grown& chart : charts_) {
      if (!wraps_u(packing_.wrap)) stay_inside(chart.centre.x, chart.half.x, page_.x);
      if (!wraps_v(packing_.wrap)) stay_inside(chart.centre.y, chart.half.y, page_.y);
    }
    // Most often the charts meet soon, and then few of them have to be looked at.
    for (double step = 0.05;; step *= 2) {
      const double bound = factor_, tried = std::min(bound, 1 + step);
      factor_ = tried;
      meet();
      if (factor_ < tried || tried == bound) return factor_;
      factor_ = bound;
    }
  }

 private:
  /// Lowers the factor to that at which the first charts meet, if they do below it.
  void meet() {
    const std::vector<Image> images = all_images();
    const double most = factor_;  // the images are sorted by their extents at this one
    for (std::size_t i = 0; i < images.size() && factor_ > 1; ++i) {
      const Image& a = images[i];
      const double right = a.centre.x + most * a.chart->half.x;
      for (std::size_t k = i + 1; k < images.size(); ++k) {
        const Image& b = images[k];
        if (b.chart->page != a.chart->page || left_of(b, most) > right) break;
        if (a.original || b.original) keep_apart(a, b);
      }
    }
  }

  void limit(double factor) { factor_ = std::max(1.0, std::min(factor_, factor)); }

  void stay_inside(double centre, double half, double length) {
    if (half > 0) limit(std::min(centre, length - centre) / half);
  }

  static double left_of(const Image& image, double factor) {
    return image.centre.x - factor * image.chart->half.x;
  }

  void keep_apart(const Image& a, const Image& b) {
    const Vec2 offset = b.centre - a.centre, reach = a.chart->half + b.chart->half;
    // Their boxes have to meet first.
    if (std::abs(offset.x) >= factor_ * reach.x || std::abs(offset.y) >= factor_ * reach.y) return;
    const double most = 1 - 1 / factor_;
    const double share =
        first_contact(a.chart->outline, b.chart->outline, offset, Vec2{0, 0} - offset, most);
    if (share < most) limit(1 / (1 - share));
  }

  /// Originals, and all images that an original may meet; by page, and then from left to right.
  [[nodiscard]] std::vector<Image> all_images() const {
    Box2 reach;  // of all originals
    for (const Grown& chart : charts_) {
      reach.add(chart.centre - factor_ * chart.half);
      reach.add(chart.centre + factor_ * chart.half);
    }
    struct Range {
      int first, last;
    };
    const auto periods = [this](bool wraps, double centre, double half, double low, double high,
                                double period) -> Range {
      if (!wraps) return {0, 0};
      return {static_cast<int>(std::ceil((low - centre - factor_ * half) / period)),
              static_cast<int>(std::floor((high - centre + factor_ * half) / period))};
    };
    std::vector<Image> images;
    for (const Grown& chart : charts_) {
      const Vec2 c = chart.centre, h = chart.half;
      const Range u = periods(wraps_u(packing_.wrap), c.x, h.x, reach.min.x, reach.max.x, page_.x);
      const Range v = periods(wraps_v(packing_.wrap), c.y, h.y, reach.min.y, reach.max.y, page_.y);
      for (int y = v.first; y <= v.last; ++y) {
        for (int x = u.first; x <= u.last; ++x) {
          images.push_back({&chart, c + Vec2{x * page_.x, y * page_.y}, x == 0 && y == 0});
        }
      }
    }
    std::stable_sort(images.begin(), images.end(), [this](const Image& a, const Image& b) {
      if (a.chart->page != b.chart->page) return a.chart->page < b.chart->page;
      return left_of(a, factor_) < left_of(b, factor_);
    });
    return images;
  }

  const Packing& packing_;
  Vec2 page_;
  std::vector<Grown> charts_;
  double factor_ = std::numeric_limits<double>::infinity();
};

}  // namespace

double unpadded_efficiency(std::span<const Chart> charts, const Packing& packing) {
  if (!(packing.efficiency > 0)) return packing.efficiency;
  const double factor = Growth(charts, packing).factor();
  return factor * factor * packing.efficiency;
}

}  // namespace wrapatlas
