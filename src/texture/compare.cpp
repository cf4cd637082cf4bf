// Wang, Bovik, Sheikh & Simoncelli, Image quality assessment: from error visibility to structural
// similarity (2004): their constants and window; where it reaches over the border of the picture
// the weights that are left are made to add up to 1.
#include <algorithm>
#include <cmath>
#include <limits>

#include "threads/parallel.h"
#include "wrapatlas/texture.h"

namespace wrapatlas {
namespace {

constexpr int kReach = 5;
constexpr double kSigma = 1.5;

double luma(const float* value, int channels) {
  if (channels < 3) return double(value[0]);
  return 0.2126 * double(value[0]) + 0.7152 * double(value[1]) + 0.0722 * double(value[2]);
}

using Values = std::vector<double>;

/// The window's weights along one axis, around each of `count` places: those that are within.
class Window {
 public:
  explicit Window(int count) : count_(count), share_(static_cast<std::size_t>(count), 0.0) {
    for (int step = -kReach; step <= kReach; ++step) {
      for (int i = begin(step); i < end(step); ++i) at(i) += weight(step);
    }
    for (double& share : share_) share = 1 / share;
  }

  static double weight(int step) { return std::exp(-step * step / (2 * kSigma * kSigma)); }
  /// From where to where `step` places further on there still is one.
  [[nodiscard]] int begin(int step) const { return std::max(0, -step); }
  [[nodiscard]] int end(int step) const { return std::min(count_, count_ - step); }
  /// What sums of weighted values are to be multiplied with.
  [[nodiscard]] double share(int i) const { return share_[static_cast<std::size_t>(i)]; }

 private:
  double& at(int i) { return share_[static_cast<std::size_t>(i)]; }

  int count_;
  Values share_;
};

/// Along rows and then down columns; both row by row, as they lie in memory.
Values blurred(const Values& values, int width, int height, int threads) {
  const Window across(width), down(height);
  const auto row = [width](auto& of, int y) { return of.data() + std::size_t{1} * y * width; };
  Values rows(values.size(), 0.0), result(values.size(), 0.0);
  const auto each_row = [&](auto&& job) {
    parallel_for(static_cast<std::size_t>(height), thread_count(threads),
                 [&](std::size_t y) { job(static_cast<int>(y)); });
  };
  each_row([&](int y) {
    const double* from = row(values, y);
    double* to = row(rows, y);
    for (int step = -kReach; step <= kReach; ++step) {
      const double weight = Window::weight(step);
      for (int x = across.begin(step); x < across.end(step); ++x) to[x] += weight * from[x + step];
    }
    for (int x = 0; x < width; ++x) to[x] *= across.share(x);
  });
  each_row([&](int y) {
    double* to = row(result, y);
    for (int step = -kReach; step <= kReach; ++step) {
      if (y < down.begin(step) || y >= down.end(step)) continue;
      const double weight = Window::weight(step) * down.share(y);
      const double* from = row(rows, y + step);
      for (int x = 0; x < width; ++x) to[x] += weight * from[x];
    }
  });
  return result;
}

double mean_ssim(const Texture& a, const Texture& b, std::span<const std::uint8_t> mask,
                 int threads) {
  constexpr double kC1 = 0.01 * 0.01, kC2 = 0.03 * 0.03;
  const std::size_t count = a.texel_count();
  Values x(count), y(count), xx(count), yy(count), xy(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = i * static_cast<std::size_t>(a.channels);
    x[i] = luma(a.values.data() + at, a.channels);
    y[i] = luma(b.values.data() + at, b.channels);
    xx[i] = x[i] * x[i];
    yy[i] = y[i] * y[i];
    xy[i] = x[i] * y[i];
  }
  for (Values* values : {&x, &y, &xx, &yy, &xy}) {
    *values = blurred(*values, a.width, a.height, threads);
  }
  double sum = 0;
  std::size_t seen = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (!mask.empty() && mask[i] == 0) continue;
    const double vx = xx[i] - x[i] * x[i], vy = yy[i] - y[i] * y[i], cov = xy[i] - x[i] * y[i];
    sum += (2 * x[i] * y[i] + kC1) * (2 * cov + kC2) /
           ((x[i] * x[i] + y[i] * y[i] + kC1) * (vx + vy + kC2));
    ++seen;
  }
  return sum / static_cast<double>(seen);
}

}  // namespace

Likeness compare(const Texture& a, const Texture& b, std::span<const std::uint8_t> mask,
                 int threads) {
  Likeness likeness;
  double squares = 0;
  const auto channels = static_cast<std::size_t>(a.channels);
  for (std::size_t i = 0; i < a.texel_count(); ++i) {
    if (!mask.empty() && mask[i] == 0) continue;
    ++likeness.pixels;
    for (std::size_t c = i * channels; c < (i + 1) * channels; ++c) {
      const double off = double(a.values[c]) - double(b.values[c]);
      squares += off * off;
    }
  }
  const double mean = squares / static_cast<double>(likeness.pixels * channels);
  likeness.psnr = mean > 0 ? -10 * std::log10(mean) : std::numeric_limits<double>::infinity();
  likeness.ssim = mean_ssim(a, b, mask, threads);
  return likeness;
}

}  // namespace wrapatlas
