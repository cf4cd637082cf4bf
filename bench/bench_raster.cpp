// rasterize() beside what the paper did (section 5): a barycentric test of every cell in the box of
// every triangle. Both work on cell centres; the conservative rule is a row of its own.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "chart_files.h"
#include "commands.h"
#include "raster/chart_raster.h"
#include "report.h"

namespace wrapatlas::bench {
namespace {

constexpr int kRotations = 4;

double angle_of(int rotation) { return 0.1 + std::numbers::pi / 8 * rotation; }

/// Rows and columns as rasterize() makes them, to be fair; horizons are left out.
std::int64_t naive_cells(const Chart& chart, double scale, double angle) {
  const double c = scale * std::cos(angle), s = scale * std::sin(angle);
  std::vector<Vec2> points;
  Box2 box;
  for (const Vec2 p : chart.points) {
    points.push_back({c * p.x - s * p.y, s * p.x + c * p.y});
    box.add(points.back());
  }
  const int width = std::max(1, static_cast<int>(std::ceil(box.size().x)));
  const int height = std::max(1, static_cast<int>(std::ceil(box.size().y)));
  std::vector<std::uint8_t> cells(static_cast<std::size_t>(width) * height);
  for (const auto& triangle : chart.triangles) {
    const Vec2 a = points[triangle[0]] - box.min, b = points[triangle[1]] - box.min;
    const Vec2 d = points[triangle[2]] - box.min;
    const double area = signed_area2(a, b, d);
    if (area == 0) continue;
    const auto [left, right] = std::minmax({a.x, b.x, d.x});
    const auto [low, high] = std::minmax({a.y, b.y, d.y});
    const int x_end = std::min(width, static_cast<int>(right) + 1);
    const int y_end = std::min(height, static_cast<int>(high) + 1);
    for (int y = static_cast<int>(low); y < y_end; ++y) {
      for (int x = static_cast<int>(left); x < x_end; ++x) {
        const Vec2 p = {x + 0.5, y + 0.5};
        const double u = signed_area2(b, d, p) / area, v = signed_area2(d, a, p) / area;
        if (u >= 0 && v >= 0 && u + v <= 1) cells[static_cast<std::size_t>(y) * width + x] = 1;
      }
    }
  }
  return std::count(cells.begin(), cells.end(), 1);
}

struct Work {
  double seconds = 0;
  std::int64_t cells = 0;
};

/// `job` rasterises one chart at one angle and returns how many cells it covers.
template <typename Job>
Work over_all(const std::vector<ChartFile>& files, int runs, Job job) {
  Work work;
  work.seconds = median_seconds(runs, [&] {
    work.cells = 0;
    std::size_t number = 0;
    for (const ChartFile& file : files) {
      for (std::size_t chart = 0; chart < file.set.charts.size(); ++chart, ++number) {
        for (int i = 0; i < kRotations; ++i) {
          work.cells += job(file, number, chart, angle_of(i));
        }
      }
    }
  });
  return work;
}

}  // namespace

int bench_raster(const ChartOptions& options) {
  const std::vector<ChartFile> files = load_chart_files(options.folder, options.stride);
  if (files.empty()) {
    fmt::print(stderr, "{}: no models with UVs here\n", options.folder);
    return 3;
  }
  std::vector<RasterShape> shapes;
  double triangles = 0;
  for (const ChartFile& file : files) {
    for (const Chart& chart : file.set.charts) {
      shapes.push_back(make_raster_shape(chart));
      triangles += kRotations * static_cast<double>(chart.triangles.size());
    }
  }
  fmt::print("options: raster, {} files of {}, {} charts at {} angles, median of {} runs\n",
             files.size(), options.folder, shapes.size(), kRotations, options.runs);
  fmt::print("Each set is scaled to half the cells of its grid. naive / time: how often faster.\n");
  Table table(
      {"what", "grid", "ms", "M cells/s", "M triangles/s", "naive / time", "cells / naive"});
  for (const int grid : {64, 256, 1024}) {
    const auto scale_of = [&](const ChartFile& file) {
      return grid * std::sqrt(0.5 / file.set.total_area());
    };
    Work naive;
    const auto add = [&](const char* name, const Work& work) {
      table.add({name, std::to_string(grid), fmt::format("{:.1f}", 1e3 * work.seconds),
                 fmt::format("{:.0f}", 1e-6 * static_cast<double>(work.cells) / work.seconds),
                 fmt::format("{:.1f}", 1e-6 * triangles / work.seconds),
                 fmt::format("{:.1f} x", naive.seconds / work.seconds),
                 fmt::format("{:.4f}",
                             static_cast<double>(work.cells) / static_cast<double>(naive.cells))});
    };
    naive = over_all(files, options.runs,
                     [&](const ChartFile& file, std::size_t, std::size_t chart, double angle) {
                       return naive_cells(file.set.charts[chart], scale_of(file), angle);
                     });
    add("naive, centres", naive);
    RasterScale scale;
    const auto run = [&](const ChartFile& file, std::size_t shape, std::size_t, double angle) {
      scale.cells_per_unit = {scale_of(file), scale_of(file)};
      return rasterize(shapes[shape], scale, angle).cells;
    };
    scale.coverage = Coverage::center;
    add("rasterize, centres", over_all(files, options.runs, run));
    scale.coverage = Coverage::conservative;
    scale.growth = 0.25;
    add("rasterize, conservative, growth 0.25", over_all(files, options.runs, run));

    std::vector<ChartRaster> rasters;
    over_all(files, 1, [&](const ChartFile& file, std::size_t shape, std::size_t, double angle) {
      scale.cells_per_unit = {scale_of(file), scale_of(file)};
      rasters.push_back(rasterize(shapes[shape], scale, angle));
      return rasters.back().cells;
    });
    std::size_t next = 0;
    add("quarter_turned of these",
        over_all(files, options.runs, [&](const ChartFile&, std::size_t, std::size_t, double) {
          return quarter_turned(rasters[next++ % rasters.size()]).cells;
        }));
  }
  table.print();
  return 0;
}

}  // namespace wrapatlas::bench
