// The faces of an atlas in colours of their own, where a texture that repeats shows them.
#include <algorithm>
#include <cmath>

#include "render/colors.h"
#include "render/samples.h"
#include "wrapatlas/view.h"

namespace wrapatlas {
namespace {

constexpr int kMostTiles = 16;  // along an axis, for a face that winds around

int wrapped(int at, int count) { return (at % count + count) % count; }

/// The samples of one tile.
class Tile {
 public:
  Tile(int columns, int rows)
      : columns_(columns), rows_(rows), samples_(std::size_t(columns) * rows, kGround) {}

  void draw(const std::array<Vec2, 3>& corner, const Color& color) {
    const double low_x = std::min({corner[0].x, corner[1].x, corner[2].x});
    const double low_y = std::min({corner[0].y, corner[1].y, corner[2].y});
    const auto pixel = [](double at) {
      return static_cast<int>(std::floor(std::clamp(at, -kFarthestSample, kFarthestSample)));
    };
    const PixelBox bounds{pixel(low_x), pixel(low_y), pixel(low_x) + kMostTiles * columns_,
                          pixel(low_y) + kMostTiles * rows_};
    for_each_span(corner, bounds, [&](int y, int begin, int end) {
      const auto row = samples_.begin() + std::ptrdiff_t(wrapped(y, rows_)) * columns_;
      const int count = std::min(end - begin, columns_), first = wrapped(begin, columns_);
      const int beyond = std::max(0, first + count - columns_);
      std::fill(row + first, row + first + count - beyond, color);
      std::fill(row, row + beyond, color);
    });
  }

  [[nodiscard]] const std::vector<Color>& samples() const { return samples_; }

 private:
  int columns_, rows_;
  std::vector<Color> samples_;
};

}  // namespace

Image draw_faces_on_atlas(const Mesh& mesh, std::span<const Color> face_colors, int width,
                          int height, int size, bool v_points_down) {
  const double scale = double(std::clamp(size, 16, 8192)) / std::max({width, height, 1});
  const int across = std::max(1, static_cast<int>(std::lround(width * scale)));
  const int down = std::max(1, static_cast<int>(std::lround(height * scale)));
  const int columns = across * kSamplesAcross, rows = down * kSamplesAcross;
  Tile tile(columns, rows);
  std::vector<Vec2> corners;
  std::vector<std::array<std::uint32_t, 3>> cut;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    corners.clear();
    cut.clear();
    for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
      if (mesh.corner_texcoord[c] == kNone) break;
      const Vec2 uv = mesh.texcoords[mesh.corner_texcoord[c]];
      corners.push_back({uv.x * columns - 0.5, (v_points_down ? uv.y : 1 - uv.y) * rows - 0.5});
    }
    if (corners.size() != mesh.face_size(face)) continue;
    triangulate_polygon(corners, cut);
    for (const auto& [i, j, k] : cut) {
      tile.draw({corners[i], corners[j], corners[k]}, face_colors[face]);
    }
  }
  return image_of_samples(tile.samples(), across, down);
}

}  // namespace wrapatlas
