// Runs the unit tests, each process in a temporary folder of its own: ctest runs many at a time.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <system_error>

int main(int argc, char** argv) {
  std::string folder = (std::filesystem::temp_directory_path() / "wrapatlas_XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr || ::setenv("TEST_TMPDIR", folder.c_str(), 1) != 0) {
    std::cerr << "cannot make a temporary folder " << folder << "\n";
    return 1;
  }
  ::testing::InitGoogleTest(&argc, argv);
  const int result = RUN_ALL_TESTS();
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  return result;
}
