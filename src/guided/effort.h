// How long a search may go on: until a time, for so many moves, or until someone says stop.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>

namespace wrapatlas {

class Effort {
 public:
  using Clock = std::chrono::steady_clock;

  /// `stop` is asked about every move.
  explicit Effort(std::function<bool()> stop) : stop_(std::move(stop)) {}

  void until(Clock::time_point deadline) { deadline_ = deadline; }
  void moves(std::int64_t count) { limit_ = count; }

  [[nodiscard]] std::int64_t moves_made() const { return moves_; }

  /// One chart was put somewhere anew, or a domain of another size was begun.
  void count_move() { ++moves_; }
  [[nodiscard]] bool stopped() const { return stop_ && stop_(); }
  [[nodiscard]] bool spent() const {
    return moves_ >= limit_ || Clock::now() >= deadline_ || stopped();
  }

 private:
  std::function<bool()> stop_;
  Clock::time_point deadline_ = Clock::time_point::max();
  std::int64_t limit_ = std::numeric_limits<std::int64_t>::max();
  std::int64_t moves_ = 0;
};

}  // namespace wrapatlas
