#include "io/ply_write.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "io/number.h"
#include "io/ply_vertices.h"

namespace wrapatlas {
namespace {

class PlyWriter {
 public:
  PlyWriter(std::string_view bytes, const PlyHeader& header, const PlyRoles& roles,
            const Mesh& mesh, const AtlasMesh& atlas)
      : bytes_(bytes),
        header_(header),
        roles_(roles),
        mesh_(mesh),
        atlas_(atlas),
        vertex_(header.elements[roles.vertex]),
        face_(header.elements[roles.face]),
        vertices_(number_ply_vertices(mesh, atlas, roles.uvs_on_vertices())),
        cursor_(bytes, header) {}

  std::string write() {
    choose_types();
    out_.reserve(bytes_.size() + bytes_.size() / 4);
    write_header();
    for (const PlyElement& element : header_.elements) {
      if (&element == &vertex_) {
        write_vertices();
      } else if (&element == &face_) {
        write_faces();
      } else {
        copy_records(element);
      }
    }
    const std::string_view rest = bytes_.substr(cursor_.here());
    const bool is_blank = rest.find_first_not_of(" \t\r\n") == std::string_view::npos;
    if (!is_text() || !is_blank) out_ += rest;
    return std::move(out_);
  }

 private:
  [[nodiscard]] bool is_text() const { return header_.encoding == PlyEncoding::text; }

  // Numbers of a record are separated in text, and the record ends with its line.
  void begin_record() { record_begin_ = out_.size(); }
  void separate() {
    if (is_text() && out_.size() != record_begin_) out_ += ' ';
  }
  void end_record() {
    if (is_text()) out_ += header_.line_end;
  }
  void append(PlyType type, double value) {
    separate();
    append_ply(out_, header_.encoding, type, value);
  }
  void append_raw(std::string_view raw) {
    separate();
    out_ += raw;
  }

  // The types of what is written to faces, wide enough for the new mesh.
  void choose_types() {
    const PlyProperty& indices = face_.properties[roles_.indices];
    indices_ = indices;
    if (roles_.texcoord >= 0) {
      texcoord_ = face_.properties[roles_.texcoord];
    } else {
      texcoord_.name = "texcoord";
      texcoord_.is_list = true;
      texcoord_.type = PlyType::float32;
    }
    std::uint32_t corners = 0;
    for (std::size_t face = 0; face < atlas_.face_count(); ++face) {
      corners = std::max(corners, atlas_.face_begin[face + 1] - atlas_.face_begin[face]);
    }
    widen(indices_.count_type, corners);
    widen(texcoord_.count_type, 2.0 * corners);
    const std::size_t vertices = mesh_.positions.size() + vertices_.added.size();
    if (!ply_is_float(indices_.type)) widen(indices_.type, static_cast<double>(vertices) - 1);
  }
  static void widen(PlyType& type, double largest) {
    if (largest > ply_max(type)) type = PlyType::uint32;
  }

  void write_header() {
    for (const PlyElement& element : header_.elements) {
      std::size_t count = element.count;
      if (&element == &vertex_) count = mesh_.positions.size() + vertices_.added.size();
      if (&element == &face_) count = atlas_.face_count();
      if (count != element.count) {
        replace(element.line, fmt::format("element {} {}", element.name, count));
      }
      if (&element != &face_) continue;
      for (int i = 0; i < static_cast<int>(element.properties.size()); ++i) {
        if (i == roles_.indices) write_property_line(element.properties[i], indices_);
        if (i == roles_.texcoord) write_property_line(element.properties[i], texcoord_);
      }
      if (roles_.texcoord >= 0 || roles_.uvs_on_vertices()) continue;
      const std::string_view last = element.properties.back().line;
      const std::string line = list_line(texcoord_);
      replace(last.substr(last.size()), fmt::format("{}{}", header_.line_end, line));
    }
    out_ += bytes_.substr(copied_, header_.body - copied_);
  }
  void write_property_line(const PlyProperty& old, const PlyProperty& changed) {
    if (old.type == changed.type && old.count_type == changed.count_type) return;
    replace(old.line, list_line(changed));
  }
  static std::string list_line(const PlyProperty& list) {
    return fmt::format("property list {} {} {}", ply_name(list.count_type), ply_name(list.type),
                       list.name);
  }
  void replace(std::string_view old, const std::string& text) {
    const auto begin = static_cast<std::size_t>(old.data() - bytes_.data());
    out_ += bytes_.substr(copied_, begin - copied_);
    out_ += text;
    copied_ = begin + old.size();
  }

  void copy_records(const PlyElement& element) {
    if (element.properties.empty()) return;
    std::string_view raw;
    if (!is_text()) {
      const std::size_t begin = cursor_.here();
      cursor_.skip(element);
      out_ += bytes_.substr(begin, cursor_.here() - begin);
      return;
    }
    for (std::uint64_t record = 0; record < element.count; ++record) {
      begin_record();
      for (const PlyProperty& property : element.properties) {
        cursor_.skip(property, raw);
        append_raw(raw);
      }
      end_record();
    }
  }

  void write_vertices() {
    std::vector<std::size_t> record_at;  // needed to repeat and to interpolate
    if (!vertices_.added.empty()) record_at.reserve(mesh_.positions.size());
    for (const std::uint32_t texcoord : vertices_.texcoord) {
      if (!vertices_.added.empty()) record_at.push_back(cursor_.here());
      write_repeated(cursor_, texcoord);
    }
    for (const PlyVertices::Added& added : vertices_.added) {
      if (added.source == kNone) {
        write_cut(record_at, atlas_.cut_points[added.cut_point], added.texcoord);
      } else {
        PlyCursor cursor(bytes_, header_);
        cursor.go_to(record_at[added.source]);
        write_repeated(cursor, added.texcoord);
      }
    }
  }

  void write_repeated(PlyCursor& source, std::uint32_t texcoord) {
    std::string_view raw;
    begin_record();
    for (int i = 0; i < static_cast<int>(vertex_.properties.size()); ++i) {
      const PlyProperty& property = vertex_.properties[i];
      source.skip(property, raw);
      if (texcoord != kNone && (i == roles_.u || i == roles_.v)) {
        append(property.type, uv(texcoord, i));
      } else {
        append_raw(raw);
      }
    }
    end_record();
  }
  [[nodiscard]] double uv(std::uint32_t texcoord, int property) const {
    const Vec2& value = atlas_.texcoords[texcoord];
    return property == roles_.u ? value.x : value.y;
  }

  void write_cut(const std::vector<std::size_t>& record_at, const AtlasMesh::CutPoint& point,
                 std::uint32_t texcoord) {
    const std::size_t count = vertex_.properties.size();
    std::vector<double> values(count);
    std::vector<std::string_view> lists(count);
    for (std::size_t k = 0; k < 3; ++k) {
      if (k != 0 && point.weights[k] == 0) continue;
      PlyCursor cursor(bytes_, header_);
      cursor.go_to(record_at[mesh_.corner_position[point.corners[k]]]);
      for (std::size_t i = 0; i < count; ++i) {
        const PlyProperty& property = vertex_.properties[i];
        std::string_view raw;
        double value = 0;
        if (property.is_list) {
          cursor.skip(property, raw);
          if (k == 0) lists[i] = raw;
        } else {
          cursor.read(property.type, value);
          values[i] = k == 0 ? point.weights[0] * value : values[i] + point.weights[k] * value;
        }
      }
    }
    normalize(values);
    begin_record();
    for (int i = 0; i < static_cast<int>(count); ++i) {
      const PlyProperty& property = vertex_.properties[i];
      const bool is_uv = texcoord != kNone && (i == roles_.u || i == roles_.v);
      if (property.is_list) {
        append_raw(lists[i]);
      } else {
        append(property.type, is_uv ? uv(texcoord, i) : values[i]);
      }
    }
    end_record();
  }

  void normalize(std::vector<double>& values) const {
    const std::array<int, 3> at{vertex_.find("nx"), vertex_.find("ny"), vertex_.find("nz")};
    for (const int i : at) {
      if (i < 0 || !ply_is_float(vertex_.properties[i].type)) return;
    }
    const double norm = length(Vec3{values[at[0]], values[at[1]], values[at[2]]});
    if (!(norm > 0)) return;
    for (const int i : at) values[i] /= norm;
  }

  void write_faces() {
    std::uint32_t atlas_face = 0;
    std::vector<std::string_view> raws(face_.properties.size());
    for (std::uint32_t face = 0; face < mesh_.face_count(); ++face) {
      for (std::size_t i = 0; i < raws.size(); ++i) cursor_.skip(face_.properties[i], raws[i]);
      for (; atlas_face < atlas_.face_count() && atlas_.face_source[atlas_face] == face;
           ++atlas_face) {
        begin_record();
        for (int i = 0; i < static_cast<int>(raws.size()); ++i) {
          if (i == roles_.indices) {
            write_indices(atlas_face);
          } else if (i == roles_.texcoord) {
            write_texcoords(atlas_face);
          } else {
            append_raw(raws[i]);
          }
        }
        if (roles_.texcoord < 0 && !roles_.uvs_on_vertices()) write_texcoords(atlas_face);
        end_record();
      }
    }
  }

  void write_indices(std::uint32_t face) {
    const std::uint32_t begin = atlas_.face_begin[face], end = atlas_.face_begin[face + 1];
    append(indices_.count_type, end - begin);
    for (std::uint32_t c = begin; c < end; ++c) {
      append(indices_.type, vertices_.corner_vertex[c]);
    }
  }

  // A face without UVs keeps those it had, if it is whole; else its list is empty.
  void write_texcoords(std::uint32_t face) {
    const std::uint32_t begin = atlas_.face_begin[face], end = atlas_.face_begin[face + 1];
    std::vector<Vec2> uvs;
    for (std::uint32_t c = begin; c < end; ++c) {
      const std::uint32_t source = atlas_.corner_source[c];
      const std::uint32_t old = source == kNone ? kNone : mesh_.corner_texcoord[source];
      if (atlas_.corner_texcoord[c] != kNone) {
        uvs.push_back(atlas_.texcoords[atlas_.corner_texcoord[c]]);
      } else if (old != kNone) {
        uvs.push_back(mesh_.texcoords[old]);
      }
    }
    if (uvs.size() != end - begin) uvs.clear();
    append(texcoord_.count_type, 2.0 * static_cast<double>(uvs.size()));
    for (const Vec2& value : uvs) {
      append(texcoord_.type, value.x);
      append(texcoord_.type, value.y);
    }
  }

  std::string_view bytes_;
  const PlyHeader& header_;
  const PlyRoles& roles_;
  const Mesh& mesh_;
  const AtlasMesh& atlas_;
  const PlyElement& vertex_;
  const PlyElement& face_;
  const PlyVertices vertices_;
  PlyCursor cursor_;
  PlyProperty indices_, texcoord_;  // as they are written
  std::string out_;
  std::size_t copied_ = 0;        // bytes of the header that are in out_
  std::size_t record_begin_ = 0;  // in out_
};

}  // namespace

Result<std::string> rewrite_ply(std::string_view bytes, const PlyHeader& header,
                                const PlyRoles& roles, const Mesh& mesh, const AtlasMesh& atlas) {
  for (const int i : {roles.x, roles.y, roles.z}) {
    if (!atlas.is_cut() || ply_is_float(header.elements[roles.vertex].properties[i].type)) continue;
    return Error{ErrorKind::output, "element vertex",
                 "its coordinates are whole numbers, which points on a cut are not",
                 "store them as float, or write without cutting"};
  }
  return PlyWriter(bytes, header, roles, mesh, atlas).write();
}

}  // namespace wrapatlas
