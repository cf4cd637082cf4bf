#include "io/obj_write.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "io/number.h"
#include "io/obj_lines.h"
#include "io/obj_plan.h"

namespace wrapatlas {
namespace {

// How many numbers stand before the indices of a statement that refers to vertices.
int words_before_indices(ObjKeyword keyword) {
  if (keyword == ObjKeyword::curv) return 2;
  return keyword == ObjKeyword::surf ? 4 : 0;
}

/// Bytes of this number are worth a call of PutBytes.
constexpr std::size_t kPiece = std::size_t{1} << 18U;

class ObjWriter {
 public:
  ObjWriter(std::string_view bytes, const Mesh& mesh, const AtlasMesh& atlas,
            std::string_view material_file, const PutBytes& put)
      : bytes_(bytes),
        mesh_(mesh),
        atlas_(atlas),
        material_file_(material_file),
        put_(put),
        plan_(bytes, mesh, atlas) {}

  Status write() {
    copied_ = bytes_.data();
    ObjLines lines(bytes_);
    for (ObjLine line; status_ && lines.next(line);) {
      if (out_.size() >= kPiece) put_out();
      if (line_end_.empty()) line_end_ = line.ending;
      ObjWords words(line.text);
      const std::string_view first = words.next();
      const ObjKeyword keyword = obj_keyword(first);
      switch (keyword) {
        case ObjKeyword::v:
          ++old_v_;
          ++v_;
          break;
        case ObjKeyword::vn:
          ++old_vn_;
          ++vn_;
          break;
        case ObjKeyword::vt:
          write_vt(words);
          break;
        case ObjKeyword::f:
          if (!plan_.in_place()) write_face(line);
          break;
        case ObjKeyword::other:
          if (first == "mtllib" && !material_file_.empty()) write_material_file(line.text);
          break;
        case ObjKeyword::o:
          break;
        default:
          if (!plan_.in_place()) renumber(words, words_before_indices(keyword));
          break;
      }
    }
    copy_until(bytes_.data() + bytes_.size());
    put_out();
    return status_;
  }

 private:
  void put_out() {
    if (status_) status_ = put_(out_);
    out_.clear();
  }
  void copy_until(const char* end) {
    const std::string_view kept(copied_, static_cast<std::size_t>(end - copied_));
    copied_ = end;
    if (kept.size() < kPiece) {
      out_ += kept;
      return;
    }
    put_out();
    if (status_) status_ = put_(kept);
  }
  void replace(std::string_view old, std::string_view text) {
    copy_until(old.data());
    out_.append(text);
    copied_ = old.data() + old.size();
  }

  /// The first such line names the one library there is; the others are left empty.
  void write_material_file(std::string_view line) {
    replace(line, "");
    if (std::exchange(named_material_file_, true)) return;
    out_ += "mtllib ";
    out_ += material_file_;
  }

  void write_vt(ObjWords words) {
    const std::uint32_t value = plan_.value_of_vt(old_vt_++);
    ++vt_;
    if (value == ObjPlan::kStays) return;
    const std::string_view u = words.next(), v = words.next();
    copy_until(u.data());
    append_uv(value);
    copied_ = v.empty() ? u.data() + u.size() : v.data() + v.size();
  }

  void append_uv(std::uint32_t texcoord) {
    append_float(out_, atlas_.texcoords[texcoord].x);
    out_ += ' ';
    append_float(out_, atlas_.texcoords[texcoord].y);
  }

  // The statements that refer to vertices besides faces: lines, points, free-form elements.
  void renumber(ObjWords words, int skip) {
    for (int i = 0; i < skip; ++i) words.next();
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      const ObjCorner corner = split_corner(word);
      if (atlas_.is_cut()) renumber(corner.v, old_v_, plan_.old_v_number);
      renumber(corner.vt, old_vt_, plan_.old_vt_number);
      if (atlas_.is_cut()) renumber(corner.vn, old_vn_, plan_.old_vn_number);
    }
  }
  void renumber(std::string_view field, std::size_t count,
                const std::vector<std::uint32_t>& numbers) {
    const std::int64_t old = obj_index(field, count);
    if (old < 0 || old >= static_cast<std::int64_t>(numbers.size())) return;
    number_.clear();
    append_integer(number_, numbers[static_cast<std::size_t>(old)]);
    replace(field, number_);
  }

  void write_face(const ObjLine& line) {
    corners_.clear();
    ObjWords words(line.text);
    words.next();
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      corners_.push_back(split_corner(word));
    }
    const std::uint32_t first = atlas_face_;
    while (atlas_face_ < atlas_.face_count() && atlas_.face_source[atlas_face_] == face_) {
      ++atlas_face_;
    }
    const std::uint32_t last = atlas_face_;
    copy_until(line.text.data());
    write_new_lines(atlas_.face_begin[first], atlas_.face_begin[last]);
    if (last == first + 1 && is_whole(first)) {
      for (std::size_t i = 0; i < corners_.size(); ++i) {
        copy_until(corners_[i].word.data());
        append_corner(atlas_.face_begin[first] + i);
        copied_ = corners_[i].word.data() + corners_[i].word.size();
      }
    } else {
      const std::string_view last_word = corners_.back().word;
      for (std::uint32_t face = first; face < last; ++face) {
        out_.append(line.text.data(), corners_[0].word.data());
        for (std::uint32_t c = atlas_.face_begin[face]; c < atlas_.face_begin[face + 1]; ++c) {
          if (c != atlas_.face_begin[face]) out_ += ' ';
          append_corner(c);
        }
        if (face + 1 != last) out_ += line_end_;
      }
      copied_ = last_word.data() + last_word.size();
    }
    ++face_;
  }

  // Has the face the corners of its source, in their order?
  [[nodiscard]] bool is_whole(std::uint32_t face) const {
    const std::uint32_t begin = atlas_.face_begin[face];
    if (atlas_.face_begin[face + 1] - begin != corners_.size()) return false;
    for (std::uint32_t i = 0; i < corners_.size(); ++i) {
      if (atlas_.corner_source[begin + i] != mesh_.face_begin[face_] + i) return false;
    }
    return true;
  }

  const ObjCorner& source_corner(std::uint32_t corner) const {
    return corners_[corner - mesh_.face_begin[face_]];
  }

  void append_corner(std::size_t c) {
    const std::uint32_t source = atlas_.corner_source[c];
    const std::uint32_t vt = plan_.vt_number(c);
    if (source == kNone) {
      const std::uint32_t point = atlas_.corner_cut[c];
      append_integer(out_, plan_.cut_v_number[plan_.cut.of_point[point]]);
      const std::uint32_t vn = plan_.cut_vn_number[point];
      append_vt_and_slashes(vt, vn != 0);
      if (vn != 0) append_integer(out_, vn);
      return;
    }
    const ObjCorner& corner = source_corner(source);
    if (!atlas_.is_cut()) {
      out_ += corner.v;
      append_vt_and_slashes(vt, !corner.vn.empty());
      out_ += corner.vn;
      return;
    }
    append_integer(out_, plan_.old_v_number[mesh_.corner_position[source]]);
    append_vt_and_slashes(vt, !corner.vn.empty());
    if (!corner.vn.empty()) append_integer(out_, plan_.old_vn_number[normal_of(corner)]);
  }

  void append_vt_and_slashes(std::uint32_t vt, bool has_normal) {
    if (vt != 0 || has_normal) out_ += '/';
    if (vt != 0) append_integer(out_, vt);
    if (has_normal) out_ += '/';
  }

  [[nodiscard]] std::size_t normal_of(const ObjCorner& corner) const {
    return static_cast<std::size_t>(obj_index(corner.vn, old_vn_));
  }

  // The v, vt and vn lines that the plan puts before the face: those with the next numbers.
  void write_new_lines(std::uint32_t first_corner, std::uint32_t last_corner) {
    for (std::uint32_t c = first_corner; c < last_corner; ++c) {
      if (atlas_.corner_source[c] != kNone) continue;
      const std::uint32_t point = atlas_.corner_cut[c];
      if (plan_.cut_v_number[plan_.cut.of_point[point]] == v_ + 1) write_new_v(point);
      if (plan_.cut_vn_number[point] == vn_ + 1) write_new_vn(atlas_.cut_points[point]);
    }
    for (std::uint32_t c = first_corner; c < last_corner; ++c) {
      const std::uint32_t texcoord = atlas_.corner_texcoord[c];
      if (texcoord == kNone || !plan_.is_added(texcoord)) continue;
      if (plan_.texcoord_number[texcoord] != vt_ + 1) continue;
      ++vt_;
      out_ += "vt ";
      append_uv(texcoord);
      out_ += line_end_;
    }
  }

  void write_new_v(std::uint32_t cut_point) {
    ++v_;
    const AtlasMesh::CutPoint& point =
        atlas_.cut_points[plan_.cut.first_point[plan_.cut.of_point[cut_point]]];
    std::array<std::vector<double>, 3> components;
    std::size_t count = static_cast<std::size_t>(-1);
    for (std::size_t i = 0; i < 3; ++i) {
      if (i != 0 && point.weights[i] == 0) continue;
      components[i] = numbers_of(plan_.v_line[mesh_.corner_position[point.corners[i]]]);
      count = std::min(count, components[i].size());
    }
    out_ += 'v';
    for (std::size_t k = 0; k < count; ++k) {
      double sum = point.weights[0] * components[0][k];
      for (std::size_t i = 1; i < 3; ++i) {
        if (point.weights[i] != 0) sum = sum + point.weights[i] * components[i][k];
      }
      out_ += ' ';
      append_number(out_, sum);
    }
    out_ += line_end_;
  }

  void write_new_vn(const AtlasMesh::CutPoint& point) {
    ++vn_;
    Vec3 sum;
    for (std::size_t i = 0; i < 3; ++i) {
      if (point.weights[i] == 0) continue;
      const ObjCorner& corner = source_corner(point.corners[i]);
      const std::vector<double> n = numbers_of(plan_.vn_line[normal_of(corner)]);
      if (n.size() >= 3) sum = sum + point.weights[i] * Vec3{n[0], n[1], n[2]};
    }
    const double norm = length(sum);
    // Opposite or unusable normals have no mean; any unit vector is as good.
    const Vec3 normal = norm > 0 ? (1 / norm) * sum : Vec3{0, 0, 1};
    out_ += "vn";
    for (const double value : {normal.x, normal.y, normal.z}) {
      out_ += ' ';
      append_number(out_, value);
    }
    out_ += line_end_;
  }

  static std::vector<double> numbers_of(std::string_view line) {
    ObjWords words(line);
    words.next();
    std::vector<double> numbers;
    for (double value = 0; parse_coordinate(words.next(), value);) numbers.push_back(value);
    return numbers;
  }

  std::string_view bytes_;
  const Mesh& mesh_;
  const AtlasMesh& atlas_;
  std::string_view material_file_;
  const PutBytes& put_;
  ObjPlan plan_;
  bool named_material_file_ = false;
  Status status_ = Done{};
  std::string out_, number_;      // out_: what is still to be put
  const char* copied_ = nullptr;  // all bytes before this one are put, in out_, or replaced
  std::string_view line_end_;
  std::vector<ObjCorner> corners_;  // of the face line at hand
  std::uint32_t face_ = 0, atlas_face_ = 0;
  std::size_t old_v_ = 0, old_vt_ = 0, old_vn_ = 0;  // lines of the source so far
  std::uint32_t v_ = 0, vt_ = 0, vn_ = 0;            // lines of the output so far
};

}  // namespace

Status rewrite_obj(std::string_view bytes, const Mesh& mesh, const AtlasMesh& atlas,
                   std::string_view material_file, const PutBytes& put) {
  return ObjWriter(bytes, mesh, atlas, material_file, put).write();
}

}  // namespace wrapatlas
