// The best packing so far, kept by all that search; it knows when to stop, and says how far the
// work is.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <optional>

#include "guided/effort.h"
#include "wrapatlas/pack.h"

namespace wrapatlas {

/// Thread-safe.
class Record {
 public:
  explicit Record(const PackOptions& options) : options_(options) {}

  /// Of packings of one efficiency that with the smallest number wins, whichever comes first.
  void offer(Packing&& packing, std::size_t number);
  [[nodiscard]] double efficiency();
  /// To be asked when no one offers any more.
  [[nodiscard]] std::optional<Packing>& best() { return best_; }

  /// Is there a time to be kept? Otherwise moves count, or it goes on until it is stuck once.
  [[nodiscard]] bool timed() const { return options_.time > 0 && options_.moves == 0; }
  /// The moment at which this share of the time has passed.
  [[nodiscard]] Effort::Clock::time_point at(double share) const;
  /// An effort that ends when someone says stop, and if timed at a share of the time.
  [[nodiscard]] Effort effort(double share);
  [[nodiscard]] bool stopped() const { return stopped_; }
  /// Reports progress now and then. True: stop.
  [[nodiscard]] bool poll();
  /// What another packer is to report to while it works for this record: the listener hears of the
  /// best of both, and its stop is one here.
  [[nodiscard]] std::function<bool(const Progress&)> reporter();
  /// Polls. True if someone said stop, or this share of the time has passed and there is a packing.
  [[nodiscard]] bool enough(double share);

 private:
  using Clock = Effort::Clock;
  /// Tells the listener, whose lock is held. False: stop.
  bool tell(double efficiency);

  const PackOptions& options_;
  std::mutex mutex_, report_mutex_;
  std::optional<Packing> best_;
  std::size_t best_number_ = 0;
  Clock::time_point start_ = Clock::now(), last_{};
  std::atomic<bool> stopped_{false};
};

}  // namespace wrapatlas
