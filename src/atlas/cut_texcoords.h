// Texcoords of a cut atlas: one for each vertex and period in which it is used.
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "wrapatlas/atlas.h"

namespace wrapatlas {

class CutTexcoords {
 public:
  CutTexcoords(const ChartSet& charts, std::vector<Vec2>& texcoords);

  /// `uv` is the point's place in [0,1], so it tells the period.
  std::uint32_t of_point(std::uint32_t chart, std::uint32_t point, Vec2 uv);
  std::uint32_t of_cut(std::uint32_t chart, std::uint32_t position, Vec2 uv);

 private:
  using Key = std::tuple<bool, std::uint32_t, std::uint32_t, double, double>;
  std::uint32_t find_or_add(const Key& key, Vec2 uv);
  std::uint32_t add(Vec2 uv);

  std::vector<Vec2>& texcoords_;
  std::vector<std::size_t> first_point_;  // per chart
  std::vector<std::uint32_t> first_use_;  // per point: nearly all need no more than this
  std::map<Key, std::uint32_t> other_uses_;
};

}  // namespace wrapatlas
