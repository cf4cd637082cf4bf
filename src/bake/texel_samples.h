// Which triangle of an atlas each sample of its texels lies on.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "wrapatlas/mesh.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {

/// Where a sample lies.
struct TexelSample {
  std::uint32_t triangle = kNone;                           ///< that it lies on, or the nearest
  float distance = std::numeric_limits<float>::infinity();  ///< texels from it; 0: on it
  std::array<double, 3> weights{};  ///< of its corners; beyond the triangle some are negative
  [[nodiscard]] bool is_on() const { return triangle != kNone && distance == 0; }
};

/// The samples of an atlas, a band of texel rows at a time: `across` x `across` to a texel, at the
/// middles of as many equal parts.
class TexelSamples {
 public:
  static constexpr double kReach = 1.5;  ///< texels from a triangle that still count

  /// Preconditions: triangles alone. `v_points_down` as Model has it; rows are from the top.
  TexelSamples(const Mesh& mesh, int width, int height, Wrap wrap, bool v_points_down, int across);

  [[nodiscard]] std::size_t band_count() const { return band_begin_.size() - 1; }
  [[nodiscard]] int rows_per_band() const { return rows_; }  ///< texels; the last may have fewer
  [[nodiscard]] int band_rows(std::size_t band) const;       ///< texels
  /// No UVs, or none of any area to speak of.
  [[nodiscard]] std::size_t faces_without_uv() const { return faces_without_uv_; }
  /// The first triangle whose UVs reach over more atlases, or lie farther away, than can be drawn,
  /// or kNone; it and those like it are left out.
  [[nodiscard]] std::uint32_t boundless_triangle() const { return boundless_; }

  /// The samples of a band, in rows of width * across. On a tie the first face has it. Thread safe.
  void read_band(std::size_t band, std::vector<TexelSample>& samples) const;

  /// Triangles that hang together by corners on the atlas have one number.
  [[nodiscard]] std::uint32_t chart(std::uint32_t triangle) const { return chart_[triangle]; }

  /// Corners in texels, rows from the top.
  [[nodiscard]] std::array<Vec2, 3> corners(std::uint32_t triangle) const;

 private:
  /// A triangle, moved by whole atlases.
  struct Image {
    std::uint32_t triangle;
    std::int32_t x, y;  ///< atlases
  };
  void find_charts();
  void add_images(std::uint32_t triangle, std::vector<Image>& images);
  [[nodiscard]] std::pair<int, int> bands_of(const Image& image) const;
  void draw(const Image& image, int first_row, int row_count,
            std::vector<TexelSample>& samples) const;

  const Mesh& mesh_;
  int width_, height_, across_, rows_;
  Wrap wrap_;
  bool v_points_down_;
  std::size_t faces_without_uv_ = 0;
  std::uint32_t boundless_ = kNone;
  std::vector<std::uint32_t> chart_;     ///< per triangle
  std::vector<std::size_t> band_begin_;  ///< per band and one more, into
  std::vector<Image> images_;            ///< by band, then by triangle
};

/// The point of a triangle in the plane that is nearest to `p`: its weights.
std::array<double, 3> nearest_weights(const std::array<Vec2, 3>& corner, Vec2 p);

}  // namespace wrapatlas
