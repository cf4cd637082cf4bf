// A model as it looks: parallel projection, a depth per sample, lines along its seams.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesh/polygon_plane.h"
#include "render/colors.h"
#include "render/samples.h"
#include "wrapatlas/view.h"

namespace wrapatlas {
namespace {

constexpr double kElevation = 20 * std::numbers::pi / 180;  ///< every other view from below
constexpr double kFirstAzimuth = 30 * std::numbers::pi / 180;
constexpr double kFilled = 0.94;  ///< of a view's side, by the model's largest extent

/// Where a view is seen from.
struct Camera {
  Vec3 right, up, back;  ///< back: towards the viewer
  double scale = 1;      ///< samples per unit
  Vec3 middle;
  double half = 0;  ///< samples

  [[nodiscard]] Vec3 place(const Vec3& p) const {  // x, y down, z: nearer is larger
    const Vec3 d = p - middle;
    return {half + scale * dot(right, d), half - scale * dot(up, d), scale * dot(back, d)};
  }
};

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

/// One view's samples.
class Canvas {
 public:
  explicit Canvas(int size)
      : size_(size * kSamplesAcross),
        color_(std::size_t(size_) * size_, kGround),
        depth_(color_.size(), -std::numeric_limits<float>::infinity()) {}

  void draw(const Mesh& mesh, std::span<const Color> face_colors, const Camera& camera) {
    std::vector<Vec2> flat;
    std::vector<Vec3> corners;
    std::vector<std::array<std::uint32_t, 3>> cut;
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
      corners.clear();
      flat.clear();
      cut.clear();
      const Vec3 normal = polygon_normal(mesh, face);
      const Plane plane(normal);
      for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
        const Vec3& p = mesh.positions[mesh.corner_position[c]];
        corners.push_back(camera.place(p));
        flat.push_back(plane.project(p));
      }
      triangulate_polygon(flat, cut);
      const double light = 0.35 + 0.65 * std::abs(dot(unit(normal), camera.back));
      const Color color = mix({0, 0, 0}, face_colors[face], light);
      for (const auto& [i, j, k] : cut) draw_triangle({corners[i], corners[j], corners[k]}, color);
    }
  }

  /// Squares of samples along each seam, where the surface is no nearer than the seam.
  void draw_seams(std::span<const SeamEdge> seams, const Camera& camera) {
    std::vector<bool> is_seam(color_.size(), false);
    for (const SeamEdge& seam : seams) {
      const Vec3 from = camera.place(seam.from), step = camera.place(seam.to) - from;
      const double steps = std::ceil(std::max({1.0, std::abs(step.x), std::abs(step.y)}));
      if (!(steps < 4.0 * size_) || !std::isfinite(from.z + step.z)) continue;
      for (int i = 0; i <= static_cast<int>(steps); ++i) mark(is_seam, from + (i / steps) * step);
    }
    for (std::size_t i = 0; i < color_.size(); ++i) {
      if (is_seam[i]) color_[i] = mix(color_[i], kGround, 0.85);
    }
  }

  [[nodiscard]] Image image() const {
    return image_of_samples(color_, size_ / kSamplesAcross, size_ / kSamplesAcross);
  }

 private:
  void draw_triangle(const std::array<Vec3, 3>& p, const Color& color) {
    const std::array<Vec2, 3> flat{{{p[0].x, p[0].y}, {p[1].x, p[1].y}, {p[2].x, p[2].y}}};
    const double area = signed_area2(flat[0], flat[1], flat[2]);
    // The plane of a sliver is a matter of rounding: its depths are kept to those of its corners.
    const double farthest = std::min({p[0].z, p[1].z, p[2].z});
    const double nearest = std::max({p[0].z, p[1].z, p[2].z});
    for_each_span(flat, {0, 0, size_, size_}, [&](int y, int begin, int end) {
      for (int x = begin; x < end; ++x) {
        const Vec2 here{double(x), double(y)};
        const double share_1 = signed_area2(flat[2], flat[0], here) / area;
        const double share_2 = signed_area2(flat[0], flat[1], here) / area;
        const double plane = p[0].z + share_1 * (p[1].z - p[0].z) + share_2 * (p[2].z - p[0].z);
        const auto depth = static_cast<float>(std::clamp(plane, farthest, nearest));
        const std::size_t at = std::size_t(y) * size_ + x;
        if (!(depth > depth_[at])) continue;  // no number, no sample
        depth_[at] = depth;
        color_[at] = color;
      }
    });
  }

  void mark(std::vector<bool>& is_seam, const Vec3& p) const {
    constexpr float kSteepest = 8;  // depth per sample beyond which it is another part
    const int reach = std::max(1, size_ / 900);
    const auto depth = static_cast<float>(p.z) + kSteepest * static_cast<float>(reach);
    const int middle_x = static_cast<int>(std::lround(p.x));
    const int middle_y = static_cast<int>(std::lround(p.y));
    for (int y = std::max(0, middle_y - reach); y <= std::min(size_ - 1, middle_y + reach); ++y) {
      for (int x = std::max(0, middle_x - reach); x <= std::min(size_ - 1, middle_x + reach); ++x) {
        const std::size_t at = std::size_t(y) * size_ + x;
        if (std::isfinite(depth_[at]) && depth_[at] <= depth) is_seam[at] = true;
      }
    }
  }

  int size_;  // samples
  std::vector<Color> color_;
  std::vector<float> depth_;
};

}  // namespace

Image draw_mesh(const Mesh& mesh, std::span<const Color> face_colors, const ViewOptions& options) {
  std::vector<Image> images;
  const int size = std::clamp(options.size, 16, 4096), views = std::clamp(options.views, 1, 8);
  for (int view = 0; view < views; ++view) {
    Canvas canvas(size);
    if (mesh.face_count() > 0) {
      const double azimuth = kFirstAzimuth + 2 * std::numbers::pi * view / views;
      const double elevation = view % 2 == 0 ? kElevation : -kElevation;
      const Camera camera = camera_at(azimuth, elevation, mesh, size * kSamplesAcross);
      canvas.draw(mesh, face_colors, camera);
      canvas.draw_seams(options.seams, camera);
    }
    images.push_back(canvas.image());
  }
  return side_by_side(images, 0);
}

}  // namespace wrapatlas
