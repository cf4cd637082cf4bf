#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wrapatlas {
namespace {

constexpr double kElevation = 20 * std::numbers::pi / 180;  ///< every other view from below
constexpr double kFirstAzimuth = 30 * std::numbers::pi / 180;
constexpr double kFilled = 0.94;  ///< of a view's side, by the model's largest extent

}  // namespace

Camera camera_at(double azimuth, double elevation, const Mesh& mesh, int samples) {
  Camera camera;
  camera.right = {std::cos(azimuth), 0, -std::sin(azimuth)};
  camera.back = {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                 std::cos(elevation) * std::cos(azimuth)};
  camera.up = cross(camera.back, camera.right);
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const std::uint32_t i : mesh.corner_position) {  // points that no face uses are not seen
    const Vec3& p = mesh.positions[i];
    const Vec3 at{dot(camera.right, p), dot(camera.up, p), dot(camera.back, p)};
    low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
    high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
  }
  const Vec3 mid = 0.5 * (low + high);
  camera.middle = mid.x * camera.right + mid.y * camera.up + mid.z * camera.back;
  // Of a line seen end on the depth counts too, or its scale would have no bound.
  const double extent = std::max({high.x - low.x, high.y - low.y, 1e-6 * (high.z - low.z)});
  camera.half = 0.5 * (samples - 1);
  camera.scale = extent > 0 ? kFilled * samples / extent : 1;
  return camera;
}

Camera camera_of_view(int view, int views, const Mesh& mesh, int samples) {
  const double azimuth = kFirstAzimuth + 2 * std::numbers::pi * view / views;
  return camera_at(azimuth, view % 2 == 0 ? kElevation : -kElevation, mesh, samples);
}

}  // namespace wrapatlas
