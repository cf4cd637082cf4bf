#include "pack/raster_cache.h"

#include <algorithm>

namespace wrapatlas {

ScaleRasters::ScaleRasters(std::span<const RasterShape> shapes,
                           std::span<const std::vector<double>> angles, const RasterScale& scale,
                           int max_side)
    : shapes_(shapes), angles_(angles), scale_(scale), max_side_(max_side), slots_(shapes.size()) {}

std::span<const ChartRaster> ScaleRasters::of(std::size_t chart) {
  Slot& slot = slots_[chart];
  std::call_once(slot.once, [&] { slot.rasters = rasters_at(angles_[chart], shapes_[chart]); });
  return slot.rasters;
}

/// Uniform angles whose number is a multiple of four are rasterised over a quarter of the circle.
std::vector<ChartRaster> ScaleRasters::rasters_at(const std::vector<double>& angles,
                                                  const RasterShape& shape) const {
  const bool square = scale_.cells_per_unit.x == scale_.cells_per_unit.y;
  const std::size_t quarter = square && angles.size() % 4 == 0 ? angles.size() / 4 : angles.size();
  std::vector<ChartRaster> rasters;
  rasters.reserve(angles.size());
  for (std::size_t i = 0; i < angles.size(); ++i) {
    rasters.push_back(i < quarter ? rasterize(shape, scale_, angles[i], max_side_)
                                  : quarter_turned(rasters[i - quarter]));
    rasters.back().angle = angles[i];
  }
  return rasters;
}

RasterCache::RasterCache(std::vector<RasterShape> shapes, std::vector<std::vector<double>> angles,
                         int max_side, std::size_t scales_kept)
    : shapes_(std::move(shapes)),
      angles_(std::move(angles)),
      max_side_(max_side),
      scales_kept_(scales_kept) {}

std::shared_ptr<ScaleRasters> RasterCache::at(const RasterScale& scale) {
  const auto same = [&](const std::shared_ptr<ScaleRasters>& entry) {
    return entry->scale().cells_per_unit == scale.cells_per_unit &&
           entry->scale().growth == scale.growth && entry->scale().coverage == scale.coverage;
  };
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(recent_.begin(), recent_.end(), same);
  if (found != recent_.end()) {
    recent_.splice(recent_.begin(), recent_, found);
    return recent_.front();
  }
  recent_.push_front(std::make_shared<ScaleRasters>(shapes_, angles_, scale, max_side_));
  if (recent_.size() > scales_kept_) recent_.pop_back();
  return recent_.front();
}

}  // namespace wrapatlas
