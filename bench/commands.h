// The benchmarks; each prints its options and its tables, and returns the exit status.
#pragma once

#include <string>

namespace wrapatlas::bench {

struct ChartOptions {
  std::string folder;
  int stride = 1;
  int runs = 5;
};

struct PackBenchOptions {
  int aspect_runs = 1;
  int aspect_threads = 2;
};

struct IoBenchOptions {
  int triangles = 1000000;
  int runs = 5;
  std::string keep;
};

struct FlattenBenchOptions {
  std::string folder;
  int stride = 1;
};

struct SeamBenchOptions {
  std::string low, other, high;
  int resolution = 256;
  int views = 12, size = 512;
};

int bench_pack(const ChartOptions& charts, const PackBenchOptions& bench);
int bench_raster(const ChartOptions& options);
int bench_slide(const ChartOptions& options);
int bench_io(const IoBenchOptions& options);
int bench_mesh();
int bench_flatten(const FlattenBenchOptions& options);
int bench_seams(const SeamBenchOptions& options);

}  // namespace wrapatlas::bench
