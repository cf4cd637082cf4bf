// Where a model is seen from: parallel projection from around it, y up.
#pragma once

#include "wrapatlas/mesh.h"

namespace wrapatlas {

/// Axes are unit vectors.
struct Camera {
  Vec3 right, up, back;  ///< back: towards the viewer
  double scale = 1;      ///< samples per unit
  Vec3 middle;
  double half = 0;  ///< samples

  /// x, y down, in samples; z: nearer is larger.
  [[nodiscard]] Vec3 place(const Vec3& p) const {
    const Vec3 d = p - middle;
    return {half + scale * dot(right, d), half - scale * dot(up, d), scale * dot(back, d)};
  }
};

/// Sees all faces of the mesh, in a square of `samples` a side. Angles in radians: azimuth around y
/// from z towards x; elevation above the horizon.
Camera camera_at(double azimuth, double elevation, const Mesh& mesh, int samples);

/// The same for one of several views side by side: evenly around, every second from below.
Camera camera_of_view(int view, int views, const Mesh& mesh, int samples);

}  // namespace wrapatlas
