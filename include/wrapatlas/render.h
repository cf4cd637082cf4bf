// A model as a renderer shows it: textured, lit, with normal maps.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "wrapatlas/mesh.h"
#include "wrapatlas/tangents.h"
#include "wrapatlas/texture.h"
#include "wrapatlas/transfer.h"

namespace wrapatlas {

/// What the light falls on.
enum class Shading {
  none,             ///< no light: the colour as it is
  flat,             ///< the faces' own normals
  smooth,           ///< smooth_normals
  object_normals,   ///< of the normal map, along the model's axes
  tangent_normals,  ///< of the normal map, along tangent_frames
};

/// Radians: azimuth around y, from z towards x; elevation above the horizon.
struct ViewDirection {
  double azimuth = 0, elevation = 0;
};

struct RenderOptions {
  int size = 768;  ///< pixels of each view, square; 16 to 4096
  int views = 2;   ///< side by side, around the model, every second from below; 1 to 64, and
                   ///< together no wider than a texture may be
  std::optional<ViewDirection> from;  ///< one view, from there, in place of those
  const Mesh* framed =
      nullptr;  ///< cameras are set up to fit this mesh, if not the one that is drawn
  Shading shading = Shading::smooth;
  std::span<const Vec3> corner_normals;            ///< the mesh's own, as in BakeOptions
  std::span<const CornerTangent> corner_tangents;  ///< the same
  double hard_angle = -1;          ///< radians: where smooth normals end, see smooth_normals
  const MipMaps* color = nullptr;  ///< linear light; without it the model is light grey
  /// In place of `color`, if there are any: colours per group of faces (without maps: the factor,
  /// or light grey), and per face its group.
  std::span<const GroupColor> group_colors;
  std::span<const std::uint32_t> face_group;
  const MipMaps* normals = nullptr;
  Wrap wrap = Wrap::uv;        ///< axes on which textures repeat; on the others they are clamped
  bool trilinear = true;       ///< else bilinear, of level 0 alone
  double level = -1;           ///< the mip level; < 0: by the size of texels on the picture
  bool v_points_down = false;  ///< of the mesh's UVs, as Model has it
  int threads = 0;             ///< 0: as many as there are; the result does not depend on it
};

/// Views in a row.
struct Rendering {
  Texture image;      ///< sRGB, 3 channels
  TexelMask covered;  ///< pixels that show the model in all their samples
  /// Of the middle sample of each pixel: face of the mesh (kNone: ground) and UV as in the mesh.
  std::vector<std::uint32_t> face;
  std::vector<Vec2> uv;
};

/// Parallel projection, as draw_mesh has it; 3 x 3 samples a pixel, averaged as light. The light is
/// the same for all shadings, and moves with the camera: 0.12 from everywhere, 0.7 from the upper
/// left, 0.18 from the viewer; faces seen from behind are lit as if turned. Level of detail: where
/// a texel and a pixel have the same area it is 0; one value per triangle and texture. Faces
/// without UVs get level 0's value at (0, 0). Preconditions: both meshes pass validate_mesh;
/// `normals` is there if the shading asks for it. O(triangles + samples) a view; 8 bytes a
/// sample of one view, 33 a pixel of all, and some 200 a triangle (300 with tangents).
Rendering render(const Mesh& mesh, const RenderOptions& options = {});

}  // namespace wrapatlas
