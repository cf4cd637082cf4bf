// A job in a process of its own, so that its peak of memory is its own.
#pragma once

#include <functional>
#include <optional>

namespace wrapatlas::bench {

struct JobResult {
  double seconds = 0;     ///< what the job returned
  double peak_bytes = 0;  ///< most memory the process ever had in RAM
};

/// Runs `job` in a child; it returns the seconds of the part that counts, or a negative number if
/// it failed. Nothing if it failed or died.
std::optional<JobResult> in_own_process(const std::function<double()>& job);

}  // namespace wrapatlas::bench
