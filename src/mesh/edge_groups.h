// Edges of faces, gathered so that all edges between the same two vertices come together.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace wrapatlas {

/// One use of an edge by a face (or triangle), from its lower to its higher vertex or back.
struct EdgeUse {
  std::uint32_t low = 0, high = 0;
  std::uint32_t face = 0;
  bool reversed = false;  ///< the face walks it from high to low
};

/// Orders edge uses by (low, high), and uses of one edge by face. O(n log d) for vertices of
/// degree d.
inline void gather_edges(std::vector<EdgeUse>& uses, std::size_t vertex_count) {
  std::vector<std::uint32_t> begin(vertex_count + 1, 0);
  for (const EdgeUse& use : uses) ++begin[use.low + 1];
  for (std::size_t v = 0; v < vertex_count; ++v) begin[v + 1] += begin[v];
  std::vector<EdgeUse> sorted(uses.size());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (const EdgeUse& use : uses) sorted[next[use.low]++] = use;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    std::sort(sorted.begin() + begin[v], sorted.begin() + begin[v + 1],
              [](const EdgeUse& a, const EdgeUse& b) {
                if (a.high != b.high) return a.high < b.high;
                return a.face != b.face ? a.face < b.face : a.reversed < b.reversed;
              });
  }
  uses.swap(sorted);
}

/// Calls visit(span of uses) for each edge of gathered uses.
template <typename Visit>
void for_each_edge(std::span<const EdgeUse> uses, Visit&& visit) {
  for (std::size_t begin = 0; begin < uses.size();) {
    std::size_t end = begin + 1;
    while (end < uses.size() && uses[end].low == uses[begin].low &&
           uses[end].high == uses[begin].high) {
      ++end;
    }
    visit(uses.subspan(begin, end - begin));
    begin = end;
  }
}

}  // namespace wrapatlas
