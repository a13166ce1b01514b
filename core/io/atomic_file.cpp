#include "core/io/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <tuple>
#include <utility>

#include "core/base/error.h"

namespace rangezip {

namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 18U;  ///< few calls, little memory
constexpr mode_t kNewFileMode = 0666;                       ///< less the umask
constexpr mode_t kPermissionBits = 0777;

/// What `path` leads to through symbolic links, also if that does not exist yet.
std::filesystem::path behind_links(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path real = std::filesystem::weakly_canonical(path, error);
  return error ? path : real;
}

/// A name of its own: one made of the target's could be too long.
std::filesystem::path temporary_beside(const std::filesystem::path& target, int attempt) {
  return target.parent_path() /
         (".rangezip-" + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".tmp");
}

}  // namespace

AtomicFile::AtomicFile(const std::filesystem::path& target) : target_(behind_links(target)) {
  struct stat status {};
  const bool is_there = ::stat(target_.c_str(), &status) == 0;
  if (is_there && S_ISDIR(status.st_mode)) {
    throw IoError(target_.string() + ": cannot be written: it is a folder");
  }
  if (is_there && !S_ISREG(status.st_mode)) {
    descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("opened for writing");
  } else {
    constexpr int kMostAttempts = 100;  // names left behind by a killed process are passed over
    for (int attempt = 0; descriptor_ < 0 && attempt < kMostAttempts; ++attempt) {
      temporary_ = temporary_beside(target_, attempt);
      descriptor_ =
          ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kNewFileMode);
      if (descriptor_ < 0 && errno != EEXIST) break;
    }
    if (descriptor_ < 0) fail("made");
    // A failure here leaves the permissions of a new file, which is no reason to refuse.
    if (is_there) std::ignore = ::fchmod(descriptor_, status.st_mode & kPermissionBits);
  }
  buffer_.reserve(kBufferSize);
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t taken = std::min(bytes.size(), kBufferSize - buffer_.size());
    buffer_.append(bytes.substr(0, taken));
    bytes.remove_prefix(taken);
    if (buffer_.size() == kBufferSize) flush_buffer();
  }
}

void AtomicFile::flush_buffer() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("written in full");
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  buffer_.clear();
}

void AtomicFile::commit() {
  flush_buffer();
  // Devices and pipes cannot be flushed to a disk, and say so by EINVAL.
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail("flushed to the disk");
  if (::close(std::exchange(descriptor_, -1)) != 0) fail("closed");
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail("renamed to its name");
  temporary_.clear();
}

void AtomicFile::fail(const std::string& action) const {
  throw IoError(target_.string() + ": cannot be " + action + ": " + std::strerror(errno));
}

}  // namespace rangezip
