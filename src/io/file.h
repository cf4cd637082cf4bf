// Whole files in and out of memory.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "wrapatlas/result.h"

namespace wrapatlas {

/// Reads a whole file. Error: input, naming the path and the system's reason.
Result<std::string> read_file(const std::filesystem::path& path);

/// Writes to a temporary file in the same folder, flushes it to disk and renames it over `path`.
/// On any failure (no permission, full disk) the temporary file is removed and `path` is as it
/// was. A path that exists and is no regular file (/dev/stdout, a pipe) is written to directly.
Status write_file(const std::filesystem::path& path, std::string_view bytes);

/// Whether write_file could begin: to be asked before long work. Error: output, the same as its.
Status check_writable(const std::filesystem::path& path);

/// Whether both paths lead to one place, also where there is nothing yet. A matter of names and
/// symbolic links: hard links are places of their own, since write_file parts them.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Takes the next piece of a file.
using PutBytes = std::function<Status(std::string_view)>;

/// The same for a file that is made piece by piece: `produce` hands them to its argument and
/// returns the first error it gets from there, or one of its own.
Status write_file(const std::filesystem::path& path,
                  const std::function<Status(const PutBytes&)>& produce);

/// Several files that appear together or not at all. While one lives on a thread, write_file on
/// that thread only prepares its file; commit() renames all of them into place, and destruction
/// without it removes them. One begun within another joins it: its commit() does nothing. A second
/// file of the same name is a usage error.
class OutputTransaction {
 public:
  OutputTransaction();
  ~OutputTransaction();
  OutputTransaction(const OutputTransaction&) = delete;
  OutputTransaction& operator=(const OutputTransaction&) = delete;
  Status commit();

 private:
  bool outermost_;
};

}  // namespace wrapatlas
