#include "own_process.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <string>

namespace wrapatlas::bench {
namespace {

/// Of this process alone; getrusage() would also count its parent up to the fork.
double peak_bytes() {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("VmHWM:", 0) == 0) return 1024 * std::stod(line.substr(6));
  }
  return 0;
}

}  // namespace

std::optional<JobResult> in_own_process(const std::function<double()>& job) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) return std::nullopt;
  std::fflush(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    JobResult result;
    result.seconds = job();
    result.peak_bytes = peak_bytes();
    std::fflush(nullptr);
    const bool sent = ::write(ends[1], &result, sizeof result) == sizeof result;
    ::_exit(sent ? 0 : 1);
  }
  ::close(ends[1]);
  JobResult result;
  const bool received = child > 0 && ::read(ends[0], &result, sizeof result) == sizeof result;
  ::close(ends[0]);
  int status = 0;
  if (child > 0) ::waitpid(child, &status, 0);
  if (!received || status != 0 || result.seconds < 0) return std::nullopt;
  return result;
}

}  // namespace wrapatlas::bench
