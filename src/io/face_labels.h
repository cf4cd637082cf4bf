// How readers note which faces are of which object, and of which material.
#pragma once

#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "wrapatlas/mesh.h"

namespace wrapatlas {

/// Says that the faces from `first` to `end` have the label; those before have been told. Nothing
/// is stored while all have label 0.
inline void assign_label(std::vector<std::uint32_t>& labels, std::size_t first, std::size_t end,
                         std::uint32_t label) {
  if (first == end || (label == 0 && labels.empty())) return;
  if (labels.empty()) labels.assign(first, 0);
  labels.resize(end, label);
}

/// The same for objects, numbered from 0 in the order of their first faces.
inline void assign_object(Mesh& mesh, std::size_t first, std::uint32_t object) {
  assign_label(mesh.face_object, first, mesh.face_count(), object);
}

/// Labels from lines of a file that hold for the faces after them, until the next one: faces after
/// lines of one and the same name have one label, so it may be taken up again.
class NamedLabels {
 public:
  /// The faces up to `end` are of the name so far; those that follow are of `name`.
  void rename(std::vector<std::uint32_t>& labels, std::size_t end, std::string_view name) {
    if (first_ != end) {
      const auto next = static_cast<std::uint32_t>(numbers_.size());
      assign_label(labels, first_, end, numbers_.try_emplace(name_, next).first->second);
      first_ = end;
    }
    name_ = name;
  }

  /// By their numbers.
  [[nodiscard]] std::vector<std::string_view> names() const {
    std::vector<std::string_view> names(numbers_.size());
    for (const auto& [name, number] : numbers_) names[number] = name;
    return names;
  }

 private:
  std::string_view name_;  ///< a part of the file's bytes
  std::unordered_map<std::string_view, std::uint32_t> numbers_;
  std::size_t first_ = 0;
};

}  // namespace wrapatlas
