// A model as it looks: parallel projection, a depth per sample, lines along its seams.
#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/polygon_plane.h"
#include "render/camera.h"
#include "render/colors.h"
#include "render/samples.h"
#include "render/visible.h"
#include "wrapatlas/view.h"

namespace wrapatlas {
namespace {

/// One view's samples.
class Canvas {
 public:
  explicit Canvas(int size)
      : size_(size * kSamplesAcross), visible_(size_), color_(visible_.sample_count(), kGround) {}

  void draw(const Mesh& mesh, std::span<const Color> face_colors, const Camera& camera) {
    std::vector<Vec2> flat;
    std::vector<Vec3> corners;
    std::vector<std::array<std::uint32_t, 3>> cut;
    std::vector<Color> lit(mesh.face_count());
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
      lit[face] = mix({0, 0, 0}, face_colors[face], light);
      for (const auto& [i, j, k] : cut) visible_.draw(face, {corners[i], corners[j], corners[k]});
    }
    for (std::size_t i = 0; i < color_.size(); ++i) {
      if (visible_.triangle(i) != kNone) color_[i] = lit[visible_.triangle(i)];
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
  void mark(std::vector<bool>& is_seam, const Vec3& p) const {
    constexpr float kSteepest = 8;  // depth per sample beyond which it is another part
    const int reach = std::max(1, size_ / 900);
    const auto depth = static_cast<float>(p.z) + kSteepest * static_cast<float>(reach);
    const int middle_x = static_cast<int>(std::lround(p.x));
    const int middle_y = static_cast<int>(std::lround(p.y));
    for (int y = std::max(0, middle_y - reach); y <= std::min(size_ - 1, middle_y + reach); ++y) {
      for (int x = std::max(0, middle_x - reach); x <= std::min(size_ - 1, middle_x + reach); ++x) {
        const std::size_t at = std::size_t(y) * size_ + x;
        if (visible_.triangle(at) != kNone && visible_.depth(at) <= depth) is_seam[at] = true;
      }
    }
  }

  int size_;         // samples
  Visible visible_;  // faces
  std::vector<Color> color_;
};

}  // namespace

Image draw_mesh(const Mesh& mesh, std::span<const Color> face_colors, const ViewOptions& options) {
  std::vector<Image> images;
  const int size = std::clamp(options.size, 16, 4096), views = std::clamp(options.views, 1, 8);
  for (int view = 0; view < views; ++view) {
    Canvas canvas(size);
    if (mesh.face_count() > 0) {
      const Camera camera = camera_of_view(view, views, mesh, size * kSamplesAcross);
      canvas.draw(mesh, face_colors, camera);
      canvas.draw_seams(options.seams, camera);
    }
    images.push_back(canvas.image());
  }
  return side_by_side(images, 0);
}

}  // namespace wrapatlas
