// Several threads at one file: whoever reads it, whenever, sees one whole version.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "io/file.h"

namespace wrapatlas {
namespace {

namespace fs = std::filesystem;

TEST(FileThreads, ReadersSeeWholeVersionsOnly) {
  const fs::path folder = fs::path(::testing::TempDir()) / "wrapatlas_file_threads_test";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const fs::path path = folder / "x";
  ASSERT_TRUE(write_file(path, std::string(1 << 16, 'a')));

  std::atomic<int> failures = 0;
  {
    std::vector<std::jthread> threads;
    for (const char letter : {'b', 'c'}) {
      threads.emplace_back([&, letter] {
        const std::string version(static_cast<std::size_t>(letter) << 10U, letter);
        for (int i = 0; i < 10; ++i) failures += write_file(path, version) ? 0 : 1;
      });
    }
    threads.emplace_back([&] {
      for (int i = 0; i < 100; ++i) {
        const auto read = read_file(path);
        const bool whole = read && !read->empty() &&
                           read->find_first_not_of(read->front()) == std::string::npos &&
                           (read->front() == 'a' ||
                            read->size() == static_cast<std::size_t>(read->front()) << 10U);
        failures += whole ? 0 : 1;
      }
    });
  }
  EXPECT_EQ(failures, 0);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1) << "a temporary file is left";
  fs::remove_all(folder);
}

}  // namespace
}  // namespace wrapatlas
