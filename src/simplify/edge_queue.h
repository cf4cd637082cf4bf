// Edges by their cost, cheapest first, of which any may change.
#pragma once

#include <cstdint>
#include <vector>

#include "wrapatlas/geometry.h"

namespace wrapatlas {

/// A heap of four children to a node. Of equal costs the edge of the lowest number comes first, so
/// the order does not depend on how the edges came in.
class EdgeQueue {
 public:
  explicit EdgeQueue(std::uint32_t edge_numbers) : place_(edge_numbers, kNone) {}

  [[nodiscard]] bool empty() const { return heap_.empty(); }
  [[nodiscard]] std::uint32_t top() const { return heap_.front().edge; }

  [[nodiscard]] bool has(std::uint32_t edge) const { return place_[edge] != kNone; }

  /// Puts the edge in, or changes its cost. O(log n).
  void set(std::uint32_t edge, double cost) {
    std::uint32_t place = place_[edge];
    if (place == kNone) {
      place = static_cast<std::uint32_t>(heap_.size());
      heap_.push_back({cost, edge});
    }
    settle(place, {cost, edge});
  }

  /// Nothing happens if it is not there. O(log n).
  void remove(std::uint32_t edge) {
    const std::uint32_t place = place_[edge];
    if (place == kNone) return;
    place_[edge] = kNone;
    const Item last = heap_.back();
    heap_.pop_back();
    if (last.edge != edge) settle(place, last);
  }

 private:
  struct Item {
    double cost;
    std::uint32_t edge;

    [[nodiscard]] bool before(const Item& other) const {
      return cost < other.cost || (cost == other.cost && edge < other.edge);
    }
  };

  void put(std::uint32_t place, const Item& item) {
    heap_[place] = item;
    place_[item.edge] = place;
  }

  /// Puts the item where it belongs, if all others but the one at `place` are where they do.
  void settle(std::uint32_t place, const Item& item) {
    while (place > 0 && item.before(heap_[(place - 1) / 4])) {
      put(place, heap_[(place - 1) / 4]);
      place = (place - 1) / 4;
    }
    const auto size = static_cast<std::uint32_t>(heap_.size());
    while (true) {
      const std::uint32_t first = 4 * place + 1;
      if (first >= size) break;
      std::uint32_t least = first;
      for (std::uint32_t i = first + 1; i < size && i < first + 4; ++i) {
        if (heap_[i].before(heap_[least])) least = i;
      }
      if (!heap_[least].before(item)) break;
      put(place, heap_[least]);
      place = least;
    }
    put(place, item);
  }

  std::vector<Item> heap_;
  std::vector<std::uint32_t> place_;  ///< per edge
};

}  // namespace wrapatlas
