#include "mesh/select_faces.h"

#include <vector>

namespace wrapatlas {
namespace {

/// Numbers what is used in the order of its first use, and copies it.
template <typename Value>
class Kept {
 public:
  Kept(const std::vector<Value>& from, std::vector<Value>& to)
      : from_(from), to_(to), number_(from.size(), kNone) {}

  std::uint32_t operator()(std::uint32_t index) {
    if (index == kNone) return kNone;
    if (number_[index] == kNone) {
      number_[index] = static_cast<std::uint32_t>(to_.size());
      to_.push_back(from_[index]);
    }
    return number_[index];
  }

 private:
  const std::vector<Value>& from_;
  std::vector<Value>& to_;
  std::vector<std::uint32_t> number_;
};

}  // namespace

Mesh select_faces(const Mesh& mesh, std::span<const std::uint32_t> faces) {
  Mesh result;
  Kept position(mesh.positions, result.positions);
  Kept texcoord(mesh.texcoords, result.texcoords);
  for (const std::uint32_t face : faces) {
    for (std::uint32_t c = mesh.face_begin[face]; c < mesh.face_begin[face + 1]; ++c) {
      result.corner_position.push_back(position(mesh.corner_position[c]));
      result.corner_texcoord.push_back(texcoord(mesh.corner_texcoord[c]));
    }
    result.face_begin.push_back(static_cast<std::uint32_t>(result.corner_position.size()));
    if (!mesh.face_object.empty()) result.face_object.push_back(mesh.face_object[face]);
  }
  return result;
}

}  // namespace wrapatlas
