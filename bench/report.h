// What the benchmarks share: the lines that say where numbers come from, clocks, tables.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace wrapatlas::bench {

/// Processor, its cores, the build, and the commit the sources are at.
void print_machine();

class Stopwatch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Of at least one number; of an even count the lower of the two in the middle.
double median(std::vector<double> values);

/// Median seconds of `runs` calls of `job`.
template <typename Job>
double median_seconds(int runs, Job job) {
  std::vector<double> seconds;
  for (int run = 0; run < runs; ++run) {
    const Stopwatch stopwatch;
    job();
    seconds.push_back(stopwatch.seconds());
  }
  return median(seconds);
}

/// Makes the compiler believe that `value` is looked at.
template <typename T>
void keep(const T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

/// Rows of cells, printed with aligned columns: the first to the left, the others to the right.
class Table {
 public:
  explicit Table(std::vector<std::string> head) : rows_{std::move(head)} {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  void print() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace wrapatlas::bench
