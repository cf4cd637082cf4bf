// Edges by their cost, cheapest first, of which any may change.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <queue>
#include <vector>

namespace wrapatlas {

/// Costs that agree in their power of two and in the next three bits, so to an eighth, count as
/// equal, and of equal ones the edge of the lowest number comes first: if numbers are near in space
/// where they are near, then so are edges that follow on each other, and memory is read in some
/// order. What comes first does not depend on how the edges came in.
///
/// Each class of cost has a bucket; the cheapest that is not empty is emptied in order. What comes
/// in at that class, or below it, goes to a heap. An edge that leaves its class is forgotten there
/// only when its turn comes, so memory is O(n + changes of class).
class EdgeQueue {
 public:
  explicit EdgeQueue(std::uint32_t edge_numbers)
      : class_(edge_numbers, kNoClass), waiting_(kClasses) {}

  [[nodiscard]] bool empty() const { return count_ == 0; }

  [[nodiscard]] bool has(std::uint32_t edge) const { return class_[edge] != kNoClass; }

  /// The first edge. Needs one.
  [[nodiscard]] std::uint32_t top() {
    while (true) {
      while (!early_.empty() && !is_there(early_.top())) early_.pop();
      while (!row_.empty() && !is_there(row_.back())) row_.pop_back();
      if (!early_.empty() && (row_.empty() || early_.top() < row_.back())) {
        return edge_of(early_.top());
      }
      if (!row_.empty()) return edge_of(row_.back());
      next_class();
    }
  }

  /// Puts the edge in, or changes its cost, which is >= 0 (and no NaN). O(1) as a rule, O(log n)
  /// for costs at or below that of the last top.
  void set(std::uint32_t edge, double cost) {
    const std::uint16_t of_cost = class_of(cost);
    if (class_[edge] == of_cost) return;  // it stands there
    if (!has(edge)) ++count_;
    class_[edge] = of_cost;
    if (of_cost > current_) {
      waiting_[of_cost].push_back(edge);
    } else {
      early_.push(item(of_cost, edge));
    }
  }

  /// Nothing happens if it is not there.
  void remove(std::uint32_t edge) {
    if (has(edge)) --count_;
    class_[edge] = kNoClass;
  }

 private:
  static constexpr std::uint32_t kClasses = 1U << 14U;  ///< eleven bits of exponent, and three
  static constexpr std::uint16_t kNoClass = 0xffff;

  static std::uint16_t class_of(double cost) {
    return static_cast<std::uint16_t>(std::bit_cast<std::uint64_t>(cost) >> 49U);
  }
  static std::uint64_t item(std::uint64_t of_cost, std::uint32_t edge) {
    return of_cost << 32U | edge;
  }
  static std::uint32_t edge_of(std::uint64_t item) { return static_cast<std::uint32_t>(item); }

  /// It may have been set to another cost since, or be gone.
  [[nodiscard]] bool is_there(std::uint64_t item) const {
    return class_[edge_of(item)] == item >> 32U;
  }

  void next_class() {
    while (waiting_[++current_].empty()) {
    }
    std::vector<std::uint32_t> edges;
    edges.swap(waiting_[current_]);  // its memory goes, too
    for (const std::uint32_t edge : edges) {
      if (class_[edge] == current_) row_.push_back(item(current_, edge));
    }
    std::sort(row_.begin(), row_.end(), std::greater<>());
  }

  std::vector<std::uint16_t> class_;                 ///< per edge: that of its cost
  std::vector<std::vector<std::uint32_t>> waiting_;  ///< per class above the current one
  std::uint32_t current_ = 0;
  std::vector<std::uint64_t> row_;  ///< of the current class, the first at the back
  /// Of the current class and those below it.
  std::priority_queue<std::uint64_t, std::vector<std::uint64_t>, std::greater<>> early_;
  std::uint32_t count_ = 0;
};

}  // namespace wrapatlas
