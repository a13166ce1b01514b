#include "core/io/file_bytes.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <utility>

#include "core/base/error.h"
#include "core/io/text_fields.h"

namespace rangezip {

namespace {

bool is_packed(const std::filesystem::path& path) {
  return to_lower(path.extension().string()) == ".gz";
}

/// Closes a file descriptor at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int value() const noexcept { return value_; }

 private:
  int value_;
};

/// zlib's state for unpacking gzip, freed at the end of its scope.
struct Inflater {
  static constexpr int kGzipWindow = 15 + 16;  ///< largest window; 16 asks for the gzip wrapper
  z_stream stream{};
  bool is_ready = false;

  Inflater() { is_ready = inflateInit2(&stream, kGzipWindow) == Z_OK; }
  ~Inflater() {
    if (is_ready) inflateEnd(&stream);
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
};

/// Bytes that zlib takes or gives between two looks at the stop token; its counters have 32 bits.
constexpr std::size_t kInflateStep = std::size_t{1} << 22U;

/// Deflate makes at most 258 bytes of two bits.
constexpr std::size_t kMostExpansion = 1032;

constexpr std::size_t kReadStep = std::size_t{1} << 20U;  ///< bytes at a time, of a pipe

constexpr int kPatience = 100;  ///< milliseconds between two looks while a pipe has nothing

std::string system_reason() {
  return std::strerror(errno);
}

/// To open a pipe waits until somebody writes into it, and no stop token ends that. So it is opened
/// without waiting; wait_for_bytes() does that.
int open_flags(const std::filesystem::path& path) {
  std::error_code error;
  return O_RDONLY | O_CLOEXEC | (std::filesystem::is_fifo(path, error) ? O_NONBLOCK : 0);
}

/// Until there is something to read, or the end, or an error.
void wait_for_bytes(int descriptor, const Progress& progress) {
  pollfd waiting{.fd = descriptor, .events = POLLIN, .revents = 0};
  do {
    progress.check_stop();
  } while (::poll(&waiting, 1, kPatience) == 0);
}

}  // namespace

std::string file_type(const std::filesystem::path& path) {
  const std::filesystem::path inner = is_packed(path) ? path.stem() : path;
  const std::string extension = to_lower(inner.extension().string());
  return extension.empty() ? extension : extension.substr(1);
}

FileBytes::FileBytes(const std::filesystem::path& path, Packing packing, const Progress& progress)
    : name_(path.string()) {
  const Descriptor file(::open(path.c_str(), open_flags(path)));
  if (file.value() < 0) fail("cannot be opened: " + system_reason());
  struct stat status {};
  if (::fstat(file.value(), &status) != 0) fail("cannot be examined: " + system_reason());
  if (S_ISDIR(status.st_mode)) fail("is a folder, not a file");
  if (S_ISREG(status.st_mode) && status.st_size > 0) {
    map(file.value(), static_cast<std::size_t>(status.st_size));
  } else if (!S_ISREG(status.st_mode)) {
    read_stream(file.value(), progress);
  }
  if (bytes_.empty()) fail("byte 0: the file is empty");
  if (packing == Packing::unpack && is_packed(path)) unpack(progress);
  if (bytes_.empty()) fail("byte 0: the unpacked file is empty");
}

FileBytes::~FileBytes() {
  if (map_ != nullptr) ::munmap(map_, map_size_);
}

void FileBytes::map(int descriptor, std::size_t size) {
  void* const address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
  if (address == MAP_FAILED) fail("cannot be mapped: " + system_reason());
  map_ = address;
  map_size_ = size;
  ::madvise(address, size, MADV_SEQUENTIAL);  // only a hint; its failure changes nothing
  bytes_ = {static_cast<const char*>(address), size};
}

void FileBytes::read_stream(int descriptor, const Progress& progress) {
  owned_ = LazyMemory(std::numeric_limits<std::size_t>::max());
  std::size_t filled = 0;
  while (true) {
    wait_for_bytes(descriptor, progress);
    if (filled == owned_.size()) fail_for_memory("gives", filled);
    const std::size_t room = std::min(owned_.size() - filled, kReadStep);
    const ssize_t got = ::read(descriptor, owned_.data() + filled, room);
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got < 0) fail("cannot be read: " + system_reason());
    if (got == 0) break;
    filled += static_cast<std::size_t>(got);
  }
  bytes_ = {owned_.data(), filled};
}

void FileBytes::unpack(const Progress& progress) {
  Inflater inflater;
  if (!inflater.is_ready) fail("zlib cannot be started");
  z_stream& stream = inflater.stream;
  LazyMemory unpacked(bytes_.size() * kMostExpansion);
  std::size_t taken = 0;
  std::size_t filled = 0;
  int result = Z_OK;
  while (result != Z_STREAM_END || taken < bytes_.size()) {
    progress.check_stop();
    if (filled == unpacked.size()) fail_for_memory("unpacks to", filled);
    const std::size_t input = std::min(bytes_.size() - taken, kInflateStep);
    const std::size_t room = std::min(unpacked.size() - filled, kInflateStep);
    // zlib's interface is not const-correct; it does not write to its input.
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes_.data() + taken));
    stream.avail_in = static_cast<uInt>(input);
    stream.next_out = reinterpret_cast<Bytef*>(unpacked.data() + filled);
    stream.avail_out = static_cast<uInt>(room);
    result = inflate(&stream, Z_NO_FLUSH);
    taken += input - stream.avail_in;
    filled += room - stream.avail_out;
    const std::string place = "byte " + std::to_string(taken) + " of the packed file: ";
    if (result == Z_STREAM_END) {
      // A gzip file may have several members, one after another, and padding of zeros.
      const std::size_t next = bytes_.find_first_not_of('\0', taken);
      taken = next == std::string_view::npos ? bytes_.size() : next;
      if (inflateReset(&stream) != Z_OK) fail("zlib cannot be restarted");
    } else if (result != Z_OK && result != Z_BUF_ERROR) {
      fail(place + "corrupt gzip data" +
           (stream.msg != nullptr ? std::string(": ") + stream.msg : ""));
    } else if (taken == bytes_.size() && stream.avail_out != 0) {
      fail(place + "the gzip data ends early: the file is cut");
    }
  }
  owned_ = std::move(unpacked);
  bytes_ = {owned_.data(), filled};
  if (map_ != nullptr) ::munmap(std::exchange(map_, nullptr), map_size_);
}

void FileBytes::fail_for_memory(const char* gives, std::size_t bytes) const {
  fail(std::string(gives) + " more than the " + std::to_string(bytes) +
       " bytes that there is memory for");
}

void FileBytes::fail(const std::string& rule) const {
  throw IoError(name_ + ": " + rule);
}

void FileBytes::fail_at_line(const char* place, const std::string& rule) const {
  const auto line = 1 + std::count(bytes_.data(), place, '\n');
  fail("line " + std::to_string(line) + ": " + rule);
}

void FileBytes::fail_at_byte(const char* place, const std::string& rule) const {
  fail("byte " + std::to_string(place - bytes_.data()) + ": " + rule);
}

}  // namespace rangezip
