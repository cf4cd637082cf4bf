#include "guided/record.h"

#include <algorithm>

namespace wrapatlas {

void Record::offer(Packing&& packing, std::size_t number) {
  const std::lock_guard lock(mutex_);
  if (best_) {
    const double now = packing.efficiency, before = best_->efficiency;
    if (now < before || (now == before && number > best_number_)) return;
  }
  best_ = std::move(packing);
  best_number_ = number;
}

double Record::efficiency() {
  const std::lock_guard lock(mutex_);
  return best_ ? best_->efficiency : 0;
}

Effort::Clock::time_point Record::at(double share) const {
  return start_ + std::chrono::duration_cast<Clock::duration>(
                      std::chrono::duration<double>(options_.time * share));
}

Effort Record::effort(double share) {
  Effort effort([this] { return poll(); });
  if (timed()) effort.until(at(share));
  return effort;
}

bool Record::enough(double share) {
  return poll() || (timed() && Clock::now() >= at(share) && efficiency() > 0);
}

bool Record::poll() {
  if (!options_.progress || stopped_) return stopped_;
  const std::unique_lock lock(report_mutex_, std::try_to_lock);
  const auto now = Clock::now();
  if (!lock || now - last_ < std::chrono::milliseconds(50)) return stopped_;
  last_ = now;
  return !tell(efficiency());
}

bool Record::tell(double efficiency) {
  if (stopped_) return false;
  const double passed = std::chrono::duration<double>(Clock::now() - start_).count();
  const double fraction = timed() ? std::min(passed / options_.time, 1.0) : 0.5;
  if (!options_.progress({fraction, efficiency})) stopped_ = true;
  return !stopped_;
}

std::function<bool(const Progress&)> Record::reporter() {
  if (!options_.progress) return {};
  return [this](const Progress& progress) {
    const std::lock_guard lock(report_mutex_);
    return tell(std::max(progress.best_efficiency, efficiency()));
  };
}

}  // namespace wrapatlas
