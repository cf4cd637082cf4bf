// Work that takes long: off the interpreter's lock, with progress, and stopped by Ctrl-C.
#pragma once

#include <nanobind/nanobind.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>

#include "failures.h"

namespace wrapatlas::python {

/// One call from Python. The work runs on a thread of its own; the calling thread waits, looks for
/// signals (Python hands them to its main thread alone) and calls the progress function there, so
/// that whatever it raises comes out of the call.
class LongWork {
 public:
  /// `progress`: None, or called with (stage, fraction, detail); False stops the work.
  /// `keep_best`: Ctrl-C is no error if the work still has a result.
  LongWork(nb::object progress, bool keep_best)
      : progress_(std::move(progress)), keep_best_(keep_best) {}

  /// For the work, from any thread. `stage` is a literal. false: stop.
  bool tell(const char* stage, double fraction, double detail = 0);

  /// The work's value, or raises: its error, or what made it stop.
  template <typename T>
  T run(const std::function<Result<T>()>& work) {
    std::optional<Result<T>> result;
    run_and_wait([&] { result.emplace(work()); });
    if (raised_ && (!keep_best_ || !*result || !is_interrupt())) {
      throw std::move(*raised_);
    }
    return take(std::move(*result));
  }

 private:
  void run_and_wait(const std::function<void()>& work);
  void look_around();
  void call_progress();
  [[nodiscard]] bool is_interrupt() const;

  struct State {
    const char* stage = nullptr;
    double fraction = 0, detail = 0;
  };

  nb::object progress_;
  bool keep_best_;
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;
  std::condition_variable finished_;
  bool is_finished_ = false;                // under mutex_
  State state_;                             // under mutex_
  State told_;                              // what progress_ was last called with
  std::exception_ptr failure_;              // the work's own, such as std::bad_alloc
  std::optional<nb::python_error> raised_;  // by a signal or by progress_
};

}  // namespace wrapatlas::python
