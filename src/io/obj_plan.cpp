#include "io/obj_plan.h"

#include "io/obj_lines.h"

namespace wrapatlas {
namespace {

constexpr std::uint32_t kUnused = kNone - 1;

}  // namespace

bool face_has_normals(std::string_view face_line) {
  ObjWords words(face_line);
  words.next();
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (split_corner(word).vn.empty()) return false;
  }
  return true;
}

ObjPlan::ObjPlan(std::string_view bytes, const Mesh& mesh, const AtlasMesh& atlas)
    : mesh_(mesh), atlas_(atlas) {
  choose_vt_values();
  if (in_place_) return;
  texcoord_number.resize(atlas.texcoords.size());
  if (atlas.is_cut()) {
    cut = number_cut_vertices(mesh, atlas);
    cut_v_number.resize(cut.first_point.size());
    cut_vn_number.resize(atlas.cut_points.size());
  }
  number_lines(bytes);
}

bool ObjPlan::is_same_uv(std::uint32_t a, std::uint32_t b) const {
  if (a == b) return true;
  return a < kUnused && b < kUnused && atlas_.texcoords[a] == atlas_.texcoords[b];
}

std::uint32_t ObjPlan::old_vt(std::size_t atlas_corner) const {
  const std::uint32_t source = atlas_.corner_source[atlas_corner];
  return source == kNone ? kNone : mesh_.corner_texcoord[source];
}

bool ObjPlan::uses_old_line(std::size_t atlas_corner) const {
  const std::uint32_t old = old_vt(atlas_corner);
  return old != kNone && is_same_uv(vt_value_[old], atlas_.corner_texcoord[atlas_corner]);
}

void ObjPlan::choose_vt_values() {
  vt_value_.assign(mesh_.texcoords.size(), kUnused);
  has_line_.resize(atlas_.texcoords.size());
  const std::size_t corners = atlas_.corner_source.size();
  for (std::size_t c = 0; c < corners; ++c) {
    if (atlas_.corner_texcoord[c] != kNone || old_vt(c) == kNone) continue;
    vt_value_[old_vt(c)] = kStays;
  }
  in_place_ = !atlas_.is_cut();
  for (std::size_t c = 0; c < corners; ++c) {
    const std::uint32_t texcoord = atlas_.corner_texcoord[c];
    if (texcoord == kNone) continue;
    const std::uint32_t old = old_vt(c);
    if (old == kNone) {
      in_place_ = false;
      continue;
    }
    if (vt_value_[old] == kUnused) {
      vt_value_[old] = texcoord;
      has_line_[texcoord] = true;
    } else if (!is_same_uv(vt_value_[old], texcoord)) {
      in_place_ = false;
    }
  }
  for (std::uint32_t& value : vt_value_) {
    if (value == kUnused) value = kStays;
  }
}

std::uint32_t ObjPlan::vt_number(std::size_t atlas_corner) const {
  if (uses_old_line(atlas_corner)) return old_vt_number[old_vt(atlas_corner)];
  const std::uint32_t texcoord = atlas_.corner_texcoord[atlas_corner];
  return texcoord == kNone ? 0 : texcoord_number[texcoord];
}

void ObjPlan::number_lines(std::string_view bytes) {
  std::uint32_t vt_count = 0, face = 0, atlas_face = 0;
  old_vt_number.reserve(mesh_.texcoords.size());
  const bool is_cut = atlas_.is_cut();
  ObjLines lines(bytes);
  for (ObjLine line; lines.next(line);) {
    switch (obj_keyword(ObjWords(line.text).next())) {
      case ObjKeyword::v:
        if (!is_cut) break;
        old_v_number.push_back(++v_count_);
        v_line.push_back(line.text);
        break;
      case ObjKeyword::vn:
        if (!is_cut) break;
        old_vn_number.push_back(++vn_count_);
        vn_line.push_back(line.text);
        break;
      case ObjKeyword::vt: {
        const std::uint32_t value = vt_value_[old_vt_number.size()];
        old_vt_number.push_back(++vt_count);
        if (value != kStays && texcoord_number[value] == 0) texcoord_number[value] = vt_count;
        break;
      }
      case ObjKeyword::f: {
        const std::uint32_t first = atlas_.face_begin[atlas_face];
        while (atlas_face < atlas_.face_count() && atlas_.face_source[atlas_face] == face) {
          ++atlas_face;
        }
        ++face;
        const std::uint32_t last = atlas_.face_begin[atlas_face];
        for (std::uint32_t c = first; c < last; ++c) {
          const std::uint32_t texcoord = atlas_.corner_texcoord[c];
          if (texcoord == kNone || has_line_[texcoord] || uses_old_line(c)) continue;
          if (texcoord_number[texcoord] == 0) texcoord_number[texcoord] = ++vt_count;
        }
        if (is_cut) number_cut_corners(line.text, first, last);
        break;
      }
      default:
        break;
    }
  }
}

void ObjPlan::number_cut_corners(std::string_view face_line, std::uint32_t first,
                                 std::uint32_t last) {
  bool has_normals = false, is_known = false;
  for (std::uint32_t c = first; c < last; ++c) {
    if (atlas_.corner_source[c] != kNone) continue;
    if (!is_known) has_normals = face_has_normals(face_line);
    is_known = true;
    const std::uint32_t point = atlas_.corner_cut[c];
    std::uint32_t& number = cut_v_number[cut.of_point[point]];
    if (number == 0) number = ++v_count_;
    if (has_normals && cut_vn_number[point] == 0) cut_vn_number[point] = ++vn_count_;
  }
}

}  // namespace wrapatlas
