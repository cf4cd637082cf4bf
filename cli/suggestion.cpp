#include "suggestion.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace wrapatlas::cli {
namespace {

/// Levenshtein's distance.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t before = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = before + (a[i] == b[j] ? 0 : 1);
      before = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_name(std::string_view given, std::span<const std::string> names) {
  std::string nearest;
  std::size_t least = std::max(given.size() / 3, std::min(given.size() / 2, std::size_t{2})) + 1;
  for (const std::string& name : names) {
    const std::size_t steps = distance(given, name);
    if (steps >= least) continue;
    least = steps;
    nearest = name;
  }
  return nearest;
}

}  // namespace wrapatlas::cli
