// slide() and best_rest(), the inner loops of the packers, beside the loops one would write first.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "chart_files.h"
#include "commands.h"
#include "pack/slide.h"
#include "report.h"

namespace wrapatlas::bench {
namespace {

constexpr int kLanes = 256;
constexpr std::size_t kCharts = 400;

/// The definition in slide.h, literally.
void slide_plainly(const Channel& channel, const Silhouette& chart, SlideResult& result) {
  for (std::size_t s = 0; s < kLanes; ++s) {
    int most = -32768, least = 32767;
    for (std::size_t c = 0; c < static_cast<std::size_t>(chart.lanes); ++c) {
      if (chart.first()[c] > chart.last()[c]) continue;
      most = std::max(most, channel.low[s + c] - chart.first()[c]);
      least = std::min(least, channel.high[s + c] - 1 - chart.last()[c]);
    }
    result.lowest[s] = static_cast<std::int16_t>(most);
    result.highest[s] = static_cast<std::int16_t>(least);
  }
}

Rest best_rest_plainly(const Channel& channel, const Silhouette& chart, const SlideResult& range) {
  Rest rest;
  for (std::size_t s = 0; s < kLanes; ++s) {
    if (range.lowest[s] > range.highest[s]) continue;
    std::int32_t gap = 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(chart.lanes); ++c) {
      if (chart.first()[c] <= chart.last()[c])
        gap += range.lowest[s] + chart.first()[c] - channel.low[s + c];
    }
    if (gap < rest.gap) rest = {gap, static_cast<int>(s), range.lowest[s]};
  }
  return rest;
}

/// A channel whose floor and ceiling wander, as packings' do.
Channel make_channel(int reach) {
  Channel channel;
  channel.resize(kLanes, reach);
  std::mt19937 random(1);
  int low = 60, high = 260;
  for (std::size_t i = 0; i < kLanes; ++i) {
    low = std::clamp(low + static_cast<int>(random() % 9) - 4, 0, 120);
    high = std::clamp(high + static_cast<int>(random() % 9) - 4, 200, 320);
    channel.low[i] = static_cast<std::int16_t>(low);
    channel.high[i] = static_cast<std::int16_t>(high);
  }
  channel.extend();
  return channel;
}

std::vector<ChartRaster> make_rasters(const std::vector<ChartFile>& files) {
  std::vector<ChartRaster> rasters;
  for (const ChartFile& file : files) {
    const double side = kLanes * std::sqrt(0.5 / file.set.total_area());
    RasterScale scale;
    scale.cells_per_unit = {side, side};
    for (const Chart& chart : file.set.charts) {
      if (rasters.size() < kCharts) {
        ChartRaster raster = rasterize(make_raster_shape(chart), scale, 0.3);
        if (raster.width > 0) rasters.push_back(std::move(raster));
      }
    }
  }
  return rasters;
}

}  // namespace

int bench_slide(const ChartOptions& options) {
  const std::vector<ChartRaster> rasters =
      make_rasters(load_chart_files(options.folder, options.stride));
  if (rasters.empty()) {
    fmt::print(stderr, "{}: no models with UVs here\n", options.folder);
    return 3;
  }
  int reach = 0;
  double steps = 0;
  for (const ChartRaster& raster : rasters) {
    reach = std::max(reach, raster.width);
    steps += double(kLanes) * raster.columns.filled_lanes;
  }
  const Channel channel = make_channel(reach);
  fmt::print("options: slide, {} charts of {}, {} shifts each, median of {} runs\n", rasters.size(),
             options.folder, kLanes, options.runs);

  SlideResult range;
  range.lowest.resize(kLanes);
  range.highest.resize(kLanes);
  const auto time_of = [&](auto job) {
    return median_seconds(options.runs, [&] {
      for (int repeat = 0; repeat < 10; ++repeat) {
        for (const ChartRaster& raster : rasters) job(raster.columns);
      }
    });
  };
  const double plain =
      time_of([&](const Silhouette& chart) { slide_plainly(channel, chart, range); });
  double scalar = 0;
  Table slides({"slide", "ns per shift and lane", "plain / time", "scalar / time"});
  const auto add_slide = [&](const char* name, double seconds) {
    slides.add({name, fmt::format("{:.3f}", 1e9 * seconds / (10 * steps)),
                fmt::format("{:.1f} x", plain / seconds),
                scalar > 0 ? fmt::format("{:.1f} x", scalar / seconds) : "-"});
  };
  add_slide("plain loop", plain);
  for (const auto& [name, function] :
       {std::pair{"scalar (compiled for SSE4)", scalar_kernels().slide},
        std::pair{"AVX2", avx2_kernels().slide}, std::pair{"AVX-512", avx512_kernels().slide}}) {
    if (function == nullptr) {
      slides.add({name, "-", "-", "-"});
      continue;
    }
    const double seconds = time_of([&, slide_with = function](const Silhouette& chart) {
      slide_with(channel.low.data(), channel.high.data(), chart, kLanes, range.lowest.data(),
                 range.highest.data());
    });
    if (scalar == 0) scalar = seconds;
    add_slide(name, seconds);
  }
  slides.print();

  std::vector<SlideResult> ranges(rasters.size());
  for (std::size_t i = 0; i < rasters.size(); ++i) {
    slide(channel, rasters[i].columns, kLanes, ranges[i]);
  }
  std::size_t next = 0;
  const auto rest_time = [&](auto job) {
    return time_of(
        [&](const Silhouette& chart) { keep(job(chart, ranges[next++ % ranges.size()])); });
  };
  const double rest_plain = rest_time([&](const Silhouette& chart, const SlideResult& of_chart) {
    return best_rest_plainly(channel, chart, of_chart);
  });
  const double rest = rest_time([&](const Silhouette& chart, const SlideResult& of_chart) {
    return best_rest(channel, chart, of_chart, 0, kLanes, Side::low);
  });
  const double charts = 10 * static_cast<double>(rasters.size());
  fmt::print("\n");
  Table rests({"best_rest", "us per chart", "plain / time"});
  rests.add({"plain loop", fmt::format("{:.2f}", 1e6 * rest_plain / charts), "1.0 x"});
  rests.add({"best_rest", fmt::format("{:.2f}", 1e6 * rest / charts),
             fmt::format("{:.1f} x", rest_plain / rest)});
  rests.print();
  return 0;
}

}  // namespace wrapatlas::bench
