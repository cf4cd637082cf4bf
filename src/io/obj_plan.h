// Which vt, v and vn lines an OBJ file will have with its new UVs, and their numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "io/cut_vertices.h"
#include "wrapatlas/atlas.h"

namespace wrapatlas {

/// All numbers are those of the output file and count from 1; 0 stands for "none yet".
class ObjPlan {
 public:
  ObjPlan(std::string_view bytes, const Mesh& mesh, const AtlasMesh& atlas);

  /// The value that a vt line of the source takes: an index into atlas.texcoords, or kStays.
  static constexpr std::uint32_t kStays = kNone;
  [[nodiscard]] std::uint32_t value_of_vt(std::size_t line) const { return vt_value_[line]; }

  /// Do all indices stay, so that only vt lines change?
  [[nodiscard]] bool in_place() const { return in_place_; }

  /// The vt number of a corner of the atlas, or 0 if it has none.
  [[nodiscard]] std::uint32_t vt_number(std::size_t atlas_corner) const;

  /// Does this texcoord stand on a line of its own, added before the first face that uses it?
  [[nodiscard]] bool is_added(std::uint32_t texcoord) const { return !has_line_[texcoord]; }

  std::vector<std::uint32_t> texcoord_number;  ///< per texcoord of the atlas
  std::vector<std::uint32_t> old_vt_number;    ///< per vt line; empty if in_place
  std::vector<std::uint32_t> old_v_number;     ///< per v line; empty unless cut, as all below
  std::vector<std::uint32_t> old_vn_number;    ///< per vn line
  std::vector<std::string_view> v_line;        ///< per v line: its text
  std::vector<std::string_view> vn_line;       ///< per vn line: its text
  std::vector<std::uint32_t> cut_v_number;     ///< per vertex of `cut`
  std::vector<std::uint32_t> cut_vn_number;    ///< per cut point
  CutVertices cut;

 private:
  void choose_vt_values();
  void number_lines(std::string_view bytes);
  void number_cut_corners(std::string_view face_line, std::uint32_t first, std::uint32_t last);
  [[nodiscard]] bool is_same_uv(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] bool uses_old_line(std::size_t atlas_corner) const;
  [[nodiscard]] std::uint32_t old_vt(std::size_t atlas_corner) const;

  const Mesh& mesh_;
  const AtlasMesh& atlas_;
  bool in_place_ = true;
  std::vector<std::uint32_t> vt_value_;
  std::vector<bool> has_line_;  // per texcoord: it took the place of an old vt line
  std::uint32_t v_count_ = 0, vn_count_ = 0;
};

/// Does every corner of this face line carry a normal?
bool face_has_normals(std::string_view face_line);

}  // namespace wrapatlas
