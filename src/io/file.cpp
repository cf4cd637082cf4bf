#include "io/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

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

}  // namespace

Result<std::string> read_file(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    return system_error(ErrorKind::input, path, "cannot open",
                        "check the path and its permissions");
  }
  struct stat info {};
  std::string bytes;
  if (::fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode)) {
    bytes.reserve(static_cast<std::size_t>(info.st_size));
  }
  std::size_t used = 0;
  for (;;) {
    if (used == bytes.size()) {
      bytes.resize(bytes.capacity() > used ? bytes.capacity() : used + (1U << 16U));
    }
    const ssize_t count = ::read(descriptor, bytes.data() + used, bytes.size() - used);
    if (count < 0) {
      if (errno == EINTR) continue;
      Error error = system_error(ErrorKind::input, path, "cannot read", "check that it is a file");
      ::close(descriptor);
      return error;
    }
    if (count == 0) break;
    used += static_cast<std::size_t>(count);
  }
  ::close(descriptor);
  bytes.resize(used);
  return bytes;
}

Status write_file(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code ignored;
  const auto kind = std::filesystem::status(path, ignored).type();
  const bool in_place =
      kind != std::filesystem::file_type::not_found && kind != std::filesystem::file_type::regular;
  std::string temporary = path.string();
  int descriptor = -1;
  if (in_place) {
    descriptor = ::open(temporary.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    temporary += ".XXXXXX";
    descriptor = ::mkostemp(temporary.data(), O_CLOEXEC);
  }
  if (descriptor < 0) {
    return system_error(ErrorKind::output, path, "cannot write",
                        "check that the folder exists and is writable");
  }
  Status written = write_all(descriptor, bytes, path);
  if (in_place) {
    ::close(descriptor);
    return written;
  }
  const mode_t mask = ::umask(0);
  ::umask(mask);
  const bool kept = written && ::fchmod(descriptor, 0666 & ~mask) == 0 && ::fsync(descriptor) == 0;
  const int keep_errno = errno;
  const bool closed = ::close(descriptor) == 0;
  if (kept && closed && ::rename(temporary.c_str(), path.c_str()) == 0) return Done{};
  if (!kept) errno = keep_errno;
  Error error = written ? system_error(ErrorKind::output, path, "cannot write",
                                       "free disk space or write elsewhere")
                        : written.error();
  ::unlink(temporary.c_str());
  return error;
}

}  // namespace wrapatlas
