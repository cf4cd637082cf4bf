// Edges by their cost, cheapest first, of which any may change.
#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "wrapatlas/geometry.h"

namespace wrapatlas {

/// A heap of four children to a node. Of costs that agree to one in two million the edge of the
/// lowest number comes first, so the order does not depend on how the edges came in.
class EdgeQueue {
 public:
  explicit EdgeQueue(std::uint32_t edge_numbers) : place_(edge_numbers, kNone) {}

  [[nodiscard]] bool empty() const { return heap_.empty(); }
  [[nodiscard]] std::uint32_t top() const { return edge_of(heap_.front()); }

  [[nodiscard]] bool has(std::uint32_t edge) const { return place_[edge] != kNone; }

  /// Puts the edge in, or changes its cost, which is >= 0. O(log n).
  void set(std::uint32_t edge, double cost) {
    std::uint32_t place = place_[edge];
    if (place == kNone) {
      place = static_cast<std::uint32_t>(heap_.size());
      heap_.push_back(0);
    }
    settle(place, item(edge, cost));
  }

  /// Nothing happens if it is not there. O(log n).
  void remove(std::uint32_t edge) {
    const std::uint32_t place = place_[edge];
    if (place == kNone) return;
    place_[edge] = kNone;
    const std::uint64_t last = heap_.back();
    heap_.pop_back();
    if (edge_of(last) != edge) settle(place, last);
  }

 private:
  /// The first bits of the cost, which as whole numbers are in the order of the costs, and the
  /// edge.
  static std::uint64_t item(std::uint32_t edge, double cost) {
    return (std::bit_cast<std::uint64_t>(cost) >> 31U << 32U) | edge;
  }
  static std::uint32_t edge_of(std::uint64_t item) { return static_cast<std::uint32_t>(item); }

  void put(std::uint32_t place, std::uint64_t item) {
    heap_[place] = item;
    place_[edge_of(item)] = place;
  }

  /// Puts the item where it belongs, if all others but the one at `place` are where they do.
  void settle(std::uint32_t place, std::uint64_t item) {
    while (place > 0 && item < heap_[(place - 1) / 4]) {
      put(place, heap_[(place - 1) / 4]);
      place = (place - 1) / 4;
    }
    const auto size = static_cast<std::uint32_t>(heap_.size());
    while (true) {
      const std::uint32_t first = 4 * place + 1;
      if (first >= size) break;
      std::uint32_t least = first;
      for (std::uint32_t i = first + 1; i < size && i < first + 4; ++i) {
        if (heap_[i] < heap_[least]) least = i;
      }
      if (!(heap_[least] < item)) break;
      put(place, heap_[least]);
      place = least;
    }
    put(place, item);
  }

  std::vector<std::uint64_t> heap_;
  std::vector<std::uint32_t> place_;  ///< per edge
};

}  // namespace wrapatlas
