#include "bake/texel_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/union_find.h"
#include "raster/row_scan.h"

namespace wrapatlas {
namespace {

constexpr double kMostAtlases = 1e6;  ///< away from [0, 1]
constexpr double kMostImages = 1024;  ///< of one triangle
constexpr double kLeastArea = 1e-12;  ///< of a triangle, square texels, doubled
constexpr int kMostRows = 16;         ///< of a band, texels
constexpr double kHair = 1e-6;        ///< texels: nearer than this is on the triangle

std::array<double, 3> weights_at(const std::array<Vec2, 3>& corner, Vec2 p) {
  const double area = signed_area2(corner[0], corner[1], corner[2]);
  const double b = signed_area2(corner[2], corner[0], p) / area;
  const double c = signed_area2(corner[0], corner[1], p) / area;
  return {1 - b - c, b, c};
}

Vec2 place(const std::array<Vec2, 3>& corner, const std::array<double, 3>& weights) {
  return weights[0] * corner[0] + weights[1] * corner[1] + weights[2] * corner[2];
}

bool is_inside(const std::array<double, 3>& weights) {
  return weights[0] >= 0 && weights[1] >= 0 && weights[2] >= 0;
}

/// As many as take up some 16 MB of samples, within reason.
int rows_of_band(int width, int across) {
  const double row = 1.0 * width * across * across * sizeof(TexelSample);
  return static_cast<int>(std::clamp(16e6 / row, 1.0, double(kMostRows)));
}

/// What a triangle has of the strip from `low` to `high`, from left to right.
Interval extent_between(const std::array<Vec2, 3>& corner, double low, double high) {
  Interval x;
  for (std::size_t i = 0; i < 3; ++i) {
    Vec2 a = corner[i], b = corner[(i + 1) % 3];
    if (a.y > b.y) std::swap(a, b);
    if (b.y < low || a.y > high) continue;
    const auto at = [&](double y) {
      return b.y > a.y ? a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)) : a.x;
    };
    const double from = a.y < low ? at(low) : a.x, to = b.y > high ? at(high) : b.x;
    x.add({std::min(from, to), std::max(from, to)});
    if (a.y == b.y) x.add({std::min(a.x, b.x), std::max(a.x, b.x)});
  }
  return x;
}

}  // namespace

std::array<double, 3> nearest_weights(const std::array<Vec2, 3>& corner, Vec2 p) {
  const std::array<double, 3> inside = weights_at(corner, p);
  if (is_inside(inside)) return inside;
  std::array<double, 3> best{1, 0, 0};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const Vec2 side = corner[j] - corner[i];
    const double size2 = dot(side, side);
    const double share = size2 > 0 ? std::clamp(dot(p - corner[i], side) / size2, 0.0, 1.0) : 0;
    const Vec2 off = corner[i] + share * side - p;
    if (dot(off, off) >= least) continue;
    least = dot(off, off);
    best = {};
    best[i] = 1 - share;
    best[j] = share;
  }
  return best;
}

TexelSamples::TexelSamples(const Mesh& mesh, int width, int height, Wrap wrap, bool v_points_down,
                           int across)
    : mesh_(mesh),
      width_(width),
      height_(height),
      across_(across),
      rows_(rows_of_band(width, across)),
      wrap_(wrap),
      v_points_down_(v_points_down) {
  find_charts();
  std::vector<Image> images;
  for (std::uint32_t triangle = 0; triangle < mesh.face_count(); ++triangle) {
    add_images(triangle, images);
  }
  const int bands = (height + rows_ - 1) / rows_;
  band_begin_.assign(static_cast<std::size_t>(bands) + 1, 0);
  for (const Image& image : images) {
    const auto [first, last] = bands_of(image);
    for (int band = first; band <= last; ++band) ++band_begin_[static_cast<std::size_t>(band) + 1];
  }
  for (std::size_t band = 1; band < band_begin_.size(); ++band) {
    band_begin_[band] += band_begin_[band - 1];
  }
  images_.resize(band_begin_.back());
  std::vector<std::size_t> next(band_begin_.begin(), band_begin_.end() - 1);
  for (const Image& image : images) {
    const auto [first, last] = bands_of(image);
    for (int band = first; band <= last; ++band) {
      images_[next[static_cast<std::size_t>(band)]++] = image;
    }
  }
}

void TexelSamples::find_charts() {
  // Corners in the order of their UVs: equal ones come together.
  std::vector<std::uint32_t> corners;
  for (std::uint32_t c = 0; c < mesh_.corner_count(); ++c) {
    if (mesh_.corner_texcoord[c] != kNone) corners.push_back(c);
  }
  const auto uv = [&](std::uint32_t c) {
    const Vec2 p = mesh_.texcoords[mesh_.corner_texcoord[c]];
    return std::pair(p.x, p.y);
  };
  std::sort(corners.begin(), corners.end(),
            [&](std::uint32_t a, std::uint32_t b) { return uv(a) < uv(b); });
  UnionFind sets(mesh_.face_count());
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (uv(corners[i]) == uv(corners[i - 1])) sets.unite(corners[i] / 3, corners[i - 1] / 3);
  }
  chart_.resize(mesh_.face_count());
  for (std::uint32_t face = 0; face < chart_.size(); ++face) chart_[face] = sets.find(face);
}

std::array<Vec2, 3> TexelSamples::corners(std::uint32_t triangle) const {
  std::array<Vec2, 3> corner;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2 uv = mesh_.texcoords[mesh_.corner_texcoord[3 * std::size_t{triangle} + i]];
    corner[i] = {width_ * uv.x, height_ * (v_points_down_ ? uv.y : 1 - uv.y)};
  }
  return corner;
}

void TexelSamples::add_images(std::uint32_t triangle, std::vector<Image>& images) {
  const std::uint32_t* texcoord = mesh_.corner_texcoord.data() + 3 * std::size_t{triangle};
  const bool has_uv = texcoord[0] != kNone && texcoord[1] != kNone && texcoord[2] != kNone;
  const std::array<Vec2, 3> corner = has_uv ? corners(triangle) : std::array<Vec2, 3>{};
  if (!has_uv || !(std::abs(signed_area2(corner[0], corner[1], corner[2])) > kLeastArea)) {
    ++faces_without_uv_;
    return;
  }
  Box2 box;
  for (const Vec2 p : corner) box.add(p);
  // Atlases by which a range must move so that it meets [0, side).
  const auto range = [](double low, double high, double side, bool wraps) {
    if (!wraps) return std::pair<std::int32_t, std::int32_t>{0, 0};
    const double first = -std::floor((high + kReach) / side);
    const double last = -std::floor((low - kReach) / side);
    if (!(std::abs(first) < kMostAtlases && std::abs(last) < kMostAtlases)) {
      return std::pair{0, static_cast<std::int32_t>(kMostImages)};  // too many
    }
    return std::pair{static_cast<std::int32_t>(first), static_cast<std::int32_t>(last)};
  };
  const auto [left, right] = range(box.min.x, box.max.x, width_, wraps_u(wrap_));
  const auto [top, bottom] = range(box.min.y, box.max.y, height_, wraps_v(wrap_));
  if ((right - left + 1.0) * (bottom - top + 1.0) > kMostImages) {
    boundless_ = std::min(boundless_, triangle);
    return;
  }
  for (std::int32_t y = top; y <= bottom; ++y) {
    for (std::int32_t x = left; x <= right; ++x) images.push_back({triangle, x, y});
  }
}

std::pair<int, int> TexelSamples::bands_of(const Image& image) const {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec2 p : corners(image.triangle)) {
    low = std::min(low, p.y + double{1} * image.y * height_);
    high = std::max(high, p.y + double{1} * image.y * height_);
  }
  const int last_band = (height_ + rows_ - 1) / rows_ - 1;
  const double first = std::floor((low - kReach) / rows_);
  const double last = std::floor((high + kReach) / rows_);
  return {static_cast<int>(std::clamp(first, 0.0, last_band + 1.0)),
          static_cast<int>(std::clamp(last, -1.0, double(last_band)))};
}

int TexelSamples::band_rows(std::size_t band) const {
  return std::min(rows_, height_ - rows_ * static_cast<int>(band));
}

void TexelSamples::read_band(std::size_t band, std::vector<TexelSample>& samples) const {
  const int rows = across_ * band_rows(band);
  samples.assign(std::size_t{1} * width_ * across_ * rows, TexelSample{});
  const int first_row = across_ * rows_ * static_cast<int>(band);
  for (std::size_t i = band_begin_[band]; i < band_begin_[band + 1]; ++i) {
    draw(images_[i], first_row, rows, samples);
  }
}

void TexelSamples::draw(const Image& image, int first_row, int row_count,
                        std::vector<TexelSample>& samples) const {
  const Vec2 by{double{1} * image.x * width_, double{1} * image.y * height_};
  std::array<Vec2, 3> corner = corners(image.triangle);
  Box2 box;
  for (Vec2& p : corner) {
    p = p + by;
    box.add(p);
  }
  const double step = 1.0 / across_;
  const auto first_at = [&](double place) { return std::ceil(across_ * place - 0.5); };
  const int columns = width_ * across_;
  const auto within = [](double value, int low, int high) {
    return static_cast<int>(std::clamp(value, double(low), double(high)));
  };
  const int last_row = first_row + row_count;
  const int begin = within(first_at(box.min.y - kReach), first_row, last_row);
  const int end = within(first_at(box.max.y + kReach) + 1, first_row, last_row);
  for (int row = begin; row < end; ++row) {
    const double y = (row + 0.5) * step;
    const Interval x = extent_between(corner, y - kReach, y + kReach);
    if (x.empty()) continue;
    const int left = within(first_at(x.low - kReach), 0, columns);
    const int right = within(first_at(x.high + kReach) + 1, 0, columns);
    for (int column = left; column < right; ++column) {
      TexelSample& sample =
          samples[std::size_t{1} * (row - first_row) * columns + static_cast<std::size_t>(column)];
      if (sample.is_on()) continue;
      const Vec2 p{(column + 0.5) * step, y};
      const std::array<double, 3> weights = weights_at(corner, p);
      double distance = 0;
      if (!is_inside(weights)) {
        distance = length(place(corner, nearest_weights(corner, p)) - p);
        if (distance < kHair) distance = 0;
        if (!(distance <= kReach)) continue;
      }
      const auto rounded = static_cast<float>(distance);
      if (sample.triangle != kNone && !(rounded < sample.distance)) continue;
      sample = {image.triangle, rounded, weights};
    }
  }
}

}  // namespace wrapatlas
