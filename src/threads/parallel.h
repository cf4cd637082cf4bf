// The one place where the library makes threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace wrapatlas {

/// `asked`, or as many as the machine has if that is 0.
inline int thread_count(int asked) {
  if (asked > 0) return asked;
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

/// Runs job(0) ... job(count - 1), each once, on up to `threads` threads, the caller's among them.
/// Jobs start in order. What a job throws (memory may run out) ends the rest, and is thrown again
/// to the caller once all threads have come to rest.
template <typename Job>
void parallel_for(std::size_t count, int threads, Job job) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) job(i);
    } catch (...) {
      next = count;
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  std::vector<std::thread> pool;
  const std::size_t wanted = std::min(count, static_cast<std::size_t>(std::max(threads, 1)));
  try {
    pool.reserve(wanted);
    while (pool.size() + 1 < wanted) pool.emplace_back(work);
  } catch (...) {
    // The system gives no more threads or memory for them: those there are do the work.
  }
  work();
  for (std::thread& thread : pool) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace wrapatlas
