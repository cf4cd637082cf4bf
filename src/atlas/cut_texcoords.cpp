#include "atlas/cut_texcoords.h"

namespace wrapatlas {

CutTexcoords::CutTexcoords(const ChartSet& charts, std::vector<Vec2>& texcoords)
    : texcoords_(texcoords) {
  std::size_t points = 0;
  for (const Chart& chart : charts.charts) {
    first_point_.push_back(points);
    points += chart.points.size();
  }
  first_use_.assign(points, kNone);
}

std::uint32_t CutTexcoords::of_point(std::uint32_t chart, std::uint32_t point, Vec2 uv) {
  std::uint32_t& first = first_use_[first_point_[chart] + point];
  if (first == kNone) first = add(uv);
  if (texcoords_[first] == uv) return first;
  return find_or_add({false, chart, point, uv.x, uv.y}, uv);
}

std::uint32_t CutTexcoords::of_cut(std::uint32_t chart, std::uint32_t position, Vec2 uv) {
  return find_or_add({true, chart, position, uv.x, uv.y}, uv);
}

std::uint32_t CutTexcoords::find_or_add(const Key& key, Vec2 uv) {
  const auto [found, is_new] = other_uses_.try_emplace(key, kNone);
  if (is_new) found->second = add(uv);
  return found->second;
}

std::uint32_t CutTexcoords::add(Vec2 uv) {
  texcoords_.push_back(uv);
  return static_cast<std::uint32_t>(texcoords_.size() - 1);
}

}  // namespace wrapatlas
