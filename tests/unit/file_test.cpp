#include "io/file.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace wrapatlas {
namespace {

namespace fs = std::filesystem;

class FileTest : public ::testing::Test {
 protected:
  FileTest() : folder_(fs::path(::testing::TempDir()) / "wrapatlas_file_test") {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~FileTest() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(FileTest, ReadsWhatWasWritten) {
  const std::string bytes("a\0b\r\n", 5);
  ASSERT_TRUE(write_file(folder_ / "x", bytes));
  auto read = read_file(folder_ / "x");
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, bytes);
}

TEST_F(FileTest, EmptyFile) {
  ASSERT_TRUE(write_file(folder_ / "x", ""));
  auto read = read_file(folder_ / "x");
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->empty());
}

TEST_F(FileTest, MissingFolderLeavesNothing) {
  const Status status = write_file(folder_ / "no" / "x", "abc");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::output);
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(FileTest, PiecesBecomeOneFileAndAFailureLeavesTheOldOne) {
  ASSERT_TRUE(write_file(folder_ / "x", [](const PutBytes& put) -> Status {
    if (Status first = put("ab"); !first) return first;
    return put("c");
  }));
  const Status failed = write_file(folder_ / "x", [](const PutBytes& put) -> Status {
    if (Status first = put("new"); !first) return first;
    return Error{ErrorKind::check, "", "changed its mind", ""};
  });
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().what, "changed its mind");
  const auto read = read_file(folder_ / "x");
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, "abc");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(FileTest, FullDiskIsReported) {
  const Status status = write_file("/dev/full", "abc");
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().kind, ErrorKind::output);
}

TEST_F(FileTest, FolderIsNotAFile) {
  const auto read = read_file(folder_);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, ErrorKind::input);
}

TEST_F(FileTest, NamesOfTheSameFile) {
  ASSERT_TRUE(write_file(folder_ / "a", ""));
  fs::create_directory(folder_ / "sub");
  fs::create_symlink(folder_ / "a", folder_ / "link");
  fs::create_directory_symlink(folder_ / "sub", folder_ / "other");
  EXPECT_TRUE(same_file(folder_ / "a", folder_ / "sub" / ".." / "a"));
  EXPECT_TRUE(same_file(folder_ / "a", folder_ / "link"));
  EXPECT_TRUE(same_file(folder_ / "sub" / "new", folder_ / "other" / "." / "new"));
  EXPECT_TRUE(same_file("new", "./new")) << "in the folder of the program";
  EXPECT_TRUE(same_file("new", fs::current_path() / "new"));
  EXPECT_FALSE(same_file(folder_ / "a", folder_ / "b"));
  EXPECT_FALSE(same_file(folder_ / "new", folder_ / "sub" / "new"));
  EXPECT_FALSE(same_file("", ""));
}

TEST_F(FileTest, TransactionRefusesTwoFilesOfOneName) {
  OutputTransaction files;
  ASSERT_TRUE(write_file(folder_ / "a", "first"));
  const Status second = write_file(folder_ / "." / "a", "second");
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().kind, ErrorKind::usage);
}

TEST_F(FileTest, TransactionIsAllOrNothing) {
  ASSERT_TRUE(write_file(folder_ / "a", "old"));
  {
    OutputTransaction files;
    ASSERT_TRUE(write_file(folder_ / "a", "new"));
    ASSERT_TRUE(write_file(folder_ / "b", "new"));
    OutputTransaction inner;
    EXPECT_TRUE(inner.commit());
    EXPECT_EQ(*read_file(folder_ / "a"), "old");
    EXPECT_FALSE(fs::exists(folder_ / "b"));
  }
  EXPECT_EQ(*read_file(folder_ / "a"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
  OutputTransaction files;
  ASSERT_TRUE(write_file(folder_ / "a", "new"));
  ASSERT_TRUE(write_file(folder_ / "b", "new"));
  ASSERT_TRUE(files.commit());
  EXPECT_EQ(*read_file(folder_ / "a"), "new");
  EXPECT_EQ(*read_file(folder_ / "b"), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 2);
}

}  // namespace
}  // namespace wrapatlas
