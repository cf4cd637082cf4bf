// Pictures of a model itself, and of values of its faces, on the model and on the atlas.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "wrapatlas/mesh.h"
#include "wrapatlas/picture.h"

namespace wrapatlas {

using Color = std::array<std::uint8_t, 3>;  ///< sRGB

/// Per face of a mesh the colour that draw_atlas gives to its chart; grey for kNone.
std::vector<Color> colors_of_charts(std::span<const std::uint32_t> face_chart);

/// Per face a colour for its value: dark blue at `low` or below, over green, to yellow at `high` or
/// above, lighter all the way; grey for what is not finite. Precondition: low < high.
std::vector<Color> colors_of_values(std::span<const double> values, double low, double high);

/// An edge at which an atlas is cut although the surface goes on.
struct SeamEdge {
  Vec3 from, to;
};

/// The edges between faces of unequal charts, and those of one chart on whose two sides the UVs of
/// an end differ. Not those where the surface ends. `mesh` passes validate_mesh; a chart for each
/// face. O(n log n).
std::vector<SeamEdge> seam_edges(const Mesh& mesh, std::span<const std::uint32_t> face_chart);

struct ViewOptions {
  int size = 768;                   ///< pixels of each view, square; 16 to 4096
  int views = 2;                    ///< side by side, from around the model; 1 to 8
  std::span<const SeamEdge> seams;  ///< drawn as dark lines where they are not hidden
};

/// The mesh seen from a little above (y is up) and every second time from a little below, in
/// parallel projection, lit from the viewer; both sides of faces are shown. Preconditions: the mesh
/// passes validate_mesh; a colour for each face. O(corners + rows of pixels that each face reaches
/// over + pixels drawn) a view, for faces of few corners; some 100 bytes a pixel of one view.
Image draw_mesh(const Mesh& mesh, std::span<const Color> face_colors,
                const ViewOptions& options = {});

/// The faces of an atlas at their UVs, filled with their colours; what lies outside [0,1] appears
/// where a texture that repeats has it, up to 16 times along an axis. Faces without UVs, or that
/// reach farther than 1e6 / (3 * size) tiles, are left out. `mesh` has the atlas applied
/// (apply_atlas). One colour per face; `size`: pixels along the longer side of an atlas of width x
/// height texels, 16 to 8192; 30 bytes a pixel.
Image draw_faces_on_atlas(const Mesh& mesh, std::span<const Color> face_colors, int width,
                          int height, int size, bool v_points_down = false);

}  // namespace wrapatlas
