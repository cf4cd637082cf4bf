#include "io/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace wrapatlas {
namespace {

Error system_error(ErrorKind kind, const std::filesystem::path& path, const char* what,
                   const char* remedy) {
  return {kind, path.string(), std::string(what) + " (" + std::strerror(errno) + ")", remedy};
}

Status write_all(int descriptor, std::string_view bytes, const std::filesystem::path& path) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count < 0) {
      if (errno == EINTR) continue;
      return system_error(ErrorKind::output, path, "cannot write",
                          "free disk space or write elsewhere");
    }
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return Done{};
}

/// Opens a new file beside `path`, with the permissions any new file gets.
int create_beside(const std::filesystem::path& path, std::string& name) {
  static std::atomic<unsigned> count{0};
  for (;;) {
    name = path.string() + ".tmp" + std::to_string(::getpid()) + "-" + std::to_string(count++);
    const int descriptor = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
  }
}

/// Reads to the end of the file, into room made for `expected` bytes at first.
Status read_all(int descriptor, std::size_t expected, const std::filesystem::path& path,
                std::string& bytes) {
  constexpr std::size_t kStep = 1U << 16U;
  std::size_t used = 0;
  bytes.resize(expected + 1);  // the extra byte lets the end show without growing
  for (;;) {
    if (used == bytes.size()) bytes.resize(used + std::max(used, kStep));
    const ssize_t count = ::read(descriptor, bytes.data() + used, bytes.size() - used);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      return system_error(ErrorKind::input, path, "cannot read", "check that it is a file");
    }
    if (count == 0) break;
    used += static_cast<std::size_t>(count);
  }
  bytes.resize(used);
  return Done{};
}

Error cannot_write(const std::filesystem::path& path) {
  return system_error(ErrorKind::output, path, "cannot write",
                      "free disk space or write elsewhere");
}

/// A finished file under its temporary name.
struct StagedFile {
  std::string temporary;
  std::filesystem::path path;
};
thread_local bool staging = false;
thread_local std::vector<StagedFile> staged;

Status move_into_place(const StagedFile& file) {
  if (::rename(file.temporary.c_str(), file.path.c_str()) == 0) return Done{};
  Error error = cannot_write(file.path);
  ::unlink(file.temporary.c_str());
  return error;
}

/// What is there and is no regular file (a device, a pipe) is written to as it is.
bool written_in_place(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto kind = std::filesystem::status(path, ignored).type();
  return kind != std::filesystem::file_type::not_found &&
         kind != std::filesystem::file_type::regular;
}

Error cannot_begin(const std::filesystem::path& path) {
  return system_error(ErrorKind::output, path, "cannot write",
                      "check that the folder exists and is writable");
}

}  // namespace

Result<std::string> read_file(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    return system_error(ErrorKind::input, path, "cannot open",
                        "check the path and its permissions");
  }
  struct stat info {};
  const bool sized = ::fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode);
  std::string bytes;
  Status read = Done{};
  try {
    read = read_all(descriptor, sized ? static_cast<std::size_t>(info.st_size) : 0, path, bytes);
  } catch (const std::exception&) {  // bad_alloc or length_error
    read = Error{ErrorKind::input, path.string(), "too large for this machine's memory",
                 "split the file, or use a machine with more memory"};
  }
  ::close(descriptor);
  if (!read) return read.error();
  return bytes;
}

bool same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  const auto place = [](const std::filesystem::path& path) {
    std::error_code code;  // on an error: no path, which is checked below
    const std::filesystem::path full = std::filesystem::absolute(path, code);
    return code ? full : std::filesystem::weakly_canonical(full, code);
  };
  const std::filesystem::path place_a = place(a);
  return !place_a.empty() && place_a == place(b);
}

Status check_writable(const std::filesystem::path& path) {
  if (written_in_place(path)) {
    std::error_code ignored;
    const bool folder = std::filesystem::is_directory(path, ignored);
    if (!folder && ::access(path.c_str(), W_OK) == 0) return Done{};
    if (folder) errno = EISDIR;
    return cannot_begin(path);
  }
  std::string temporary;
  const int descriptor = create_beside(path, temporary);
  if (descriptor < 0) return cannot_begin(path);
  ::close(descriptor);
  ::unlink(temporary.c_str());
  return Done{};
}

Status write_file(const std::filesystem::path& path, std::string_view bytes) {
  return write_file(path, [bytes](const PutBytes& put) { return put(bytes); });
}

Status write_file(const std::filesystem::path& path,
                  const std::function<Status(const PutBytes&)>& produce) {
  const bool in_place = written_in_place(path);
  const auto is_path = [&](const StagedFile& file) { return same_file(file.path, path); };
  if (staging && !in_place && std::any_of(staged.begin(), staged.end(), is_path)) {
    return Error{ErrorKind::usage, path.string(), "two outputs have this name",
                 "give each output a name of its own"};
  }
  std::string temporary = path.string();
  const int descriptor =
      in_place ? ::open(path.c_str(), O_WRONLY | O_CLOEXEC) : create_beside(path, temporary);
  if (descriptor < 0) return cannot_begin(path);
  Status written = Done{};
  try {
    written = produce(
        [descriptor, &path](std::string_view bytes) { return write_all(descriptor, bytes, path); });
  } catch (const std::exception&) {  // bad_alloc, mostly
    written = Error{ErrorKind::output, path.string(), "out of memory while writing",
                    "use a machine with more memory"};
  }
  if (in_place) {
    ::close(descriptor);
    return written;
  }
  if (written && ::fsync(descriptor) != 0) written = cannot_write(path);
  if (::close(descriptor) != 0 && written) written = cannot_write(path);
  if (!written) {
    ::unlink(temporary.c_str());
    return written;
  }
  if (staging) {
    staged.push_back({std::move(temporary), path});
    return Done{};
  }
  return move_into_place({std::move(temporary), path});
}

OutputTransaction::OutputTransaction() : outermost_(!staging) { staging = true; }

OutputTransaction::~OutputTransaction() {
  if (!outermost_) return;
  for (const StagedFile& file : staged) ::unlink(file.temporary.c_str());
  staged.clear();
  staging = false;
}

Status OutputTransaction::commit() {
  if (!outermost_) return Done{};
  // A rename fails where a folder has the name; that is known before the first one is made.
  for (const StagedFile& file : staged) {
    if (std::filesystem::is_directory(file.path)) {
      errno = EISDIR;
      return cannot_write(file.path);
    }
  }
  while (!staged.empty()) {
    const StagedFile file = staged.front();
    staged.erase(staged.begin());
    if (Status moved = move_into_place(file); !moved) return moved;
  }
  return Done{};
}

}  // namespace wrapatlas
