#include "atlas/split_triangle.h"

#include <algorithm>
#include <cmath>

namespace wrapatlas {

void TriangleSplitter::clear() {
  nodes.clear();
  crossings_.clear();
}

std::vector<TriangleSplitter::Ring> TriangleSplitter::split(const Ring& ring, Wrap wrap) {
  std::vector<Ring> pieces;
  for (Ring& strip : wraps_u(wrap) ? split_along(ring, 0) : std::vector<Ring>{ring}) {
    if (!wraps_v(wrap)) {
      pieces.push_back(std::move(strip));
      continue;
    }
    for (Ring& piece : split_along(std::move(strip), 1)) pieces.push_back(std::move(piece));
  }
  std::erase_if(pieces, [](const Ring& piece) { return piece.size() < 3; });
  return pieces;
}

std::vector<TriangleSplitter::Ring> TriangleSplitter::split_along(Ring ring, int axis) {
  const auto at = [&](std::uint32_t node) { return coordinate(nodes[node].uv, axis); };
  double low = at(ring[0]), high = low;
  for (const std::uint32_t node : ring) {
    low = std::min(low, at(node));
    high = std::max(high, at(node));
  }
  std::vector<Ring> parts;
  const double first = std::floor(low) + 1;  // of the lines strictly between low and high
  const auto lines = static_cast<std::int64_t>(std::max(0.0, std::ceil(high) - first));
  for (std::int64_t i = 0; i < lines; ++i) {
    const double line = first + static_cast<double>(i);
    Ring below, above;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::uint32_t node = ring[k], next = ring[(k + 1) % ring.size()];
      if (at(node) <= line) below.push_back(node);
      if (at(node) >= line) above.push_back(node);
      if ((at(node) < line && line < at(next)) || (at(next) < line && line < at(node))) {
        const std::uint32_t crossing = crossing_node(node, next, axis, line);
        below.push_back(crossing);
        above.push_back(crossing);
      }
    }
    parts.push_back(std::move(below));
    ring = std::move(above);
  }
  parts.push_back(std::move(ring));
  return parts;
}

std::uint32_t TriangleSplitter::crossing_node(std::uint32_t a, std::uint32_t b, int axis,
                                              double line) {
  if (a > b) std::swap(a, b);
  const auto fresh = static_cast<std::uint32_t>(nodes.size());
  const auto [found, is_new] = crossings_.try_emplace({a, b, axis, line}, fresh);
  if (!is_new) return found->second;
  const CutNode& from = nodes[a];
  const CutNode& to = nodes[b];
  const double start = coordinate(from.uv, axis);
  const double t = (line - start) / (coordinate(to.uv, axis) - start);
  CutNode node;
  node.uv = from.uv + t * (to.uv - from.uv);
  (axis == 0 ? node.uv.x : node.uv.y) = line;
  for (std::size_t i = 0; i < 3; ++i) {
    node.weights[i] = (1 - t) * from.weights[i] + t * to.weights[i];
  }
  nodes.push_back(node);
  return fresh;
}

}  // namespace wrapatlas
