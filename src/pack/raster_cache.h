// Rasters of all charts at all their angles, made once per scale and shared between attempts.
#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "raster/chart_raster.h"

namespace wrapatlas {

/// The rasters of one scale. Each chart's are made when first asked for, by whichever thread asks.
class ScaleRasters {
 public:
  ScaleRasters(std::span<const RasterShape> shapes, std::span<const std::vector<double>> angles,
               const RasterScale& scale, int max_side);

  [[nodiscard]] std::span<const ChartRaster> of(std::size_t chart);
  [[nodiscard]] const RasterScale& scale() const { return scale_; }

 private:
  struct Slot {
    std::once_flag once;
    std::vector<ChartRaster> rasters;
  };
  [[nodiscard]] std::vector<ChartRaster> rasters_at(const std::vector<double>& angles,
                                                    const RasterShape& shape) const;

  std::span<const RasterShape> shapes_;
  std::span<const std::vector<double>> angles_;  ///< per chart, uniform over the circle
  RasterScale scale_;
  int max_side_;
  std::vector<Slot> slots_;
};

/// Keeps the rasters of the scales used last. Aspect ratios of one area search the same scales, so
/// they find them here. Thread-safe.
class RasterCache {
 public:
  /// No raster is longer than `max_side` cells.
  RasterCache(std::vector<RasterShape> shapes, std::vector<std::vector<double>> angles,
              int max_side, std::size_t scales_kept);

  std::shared_ptr<ScaleRasters> at(const RasterScale& scale);
  [[nodiscard]] int max_side() const { return max_side_; }

 private:
  std::vector<RasterShape> shapes_;
  std::vector<std::vector<double>> angles_;
  int max_side_;
  std::size_t scales_kept_;
  std::mutex mutex_;
  std::list<std::shared_ptr<ScaleRasters>> recent_;  ///< most recently used first
};

}  // namespace wrapatlas
