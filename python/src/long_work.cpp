#include "long_work.h"

#include <chrono>
#include <thread>

namespace wrapatlas::python {
namespace {

constexpr std::chrono::milliseconds kLookEvery{50};

}  // namespace

bool LongWork::tell(const char* stage, double fraction, double detail) {
  const std::lock_guard lock(mutex_);
  state_ = {stage, fraction, detail};
  return !stopped_;
}

void LongWork::run_and_wait(const std::function<void()>& work) {
  {
    const nb::gil_scoped_release unlocked;
    std::thread worker([&] {
      try {
        work();
      } catch (...) {
        failure_ = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      is_finished_ = true;
      finished_.notify_one();
    });
    for (;;) {
      {
        std::unique_lock lock(mutex_);
        if (finished_.wait_for(lock, kLookEvery, [&] { return is_finished_; })) break;
      }
      const nb::gil_scoped_acquire locked;
      look_around();
    }
    worker.join();
  }
  if (failure_) std::rethrow_exception(failure_);
  look_around();  // a signal of the last moment; the end of the last stage
}

void LongWork::look_around() {
  if (raised_) return;
  try {
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    call_progress();
  } catch (nb::python_error& error) {
    raised_.emplace(std::move(error));
    stopped_ = true;
  }
}

void LongWork::call_progress() {
  if (progress_.is_none()) return;
  State now;
  {
    const std::lock_guard lock(mutex_);
    now = state_;
  }
  if (now.stage == nullptr) return;
  if (now.stage == told_.stage && now.fraction == told_.fraction && now.detail == told_.detail) {
    return;
  }
  told_ = now;
  const nb::object answer = progress_(now.stage, now.fraction, now.detail);
  if (answer.is(nb::bool_(false))) stopped_ = true;
}

bool LongWork::is_interrupt() const { return raised_->matches(PyExc_KeyboardInterrupt); }

}  // namespace wrapatlas::python
