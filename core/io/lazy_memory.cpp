#include "core/io/lazy_memory.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <utility>

namespace rangezip {

namespace {

constexpr std::size_t kUnknown = std::numeric_limits<std::size_t>::max();

/// Bytes that can be written to before the system must end some process: free, or of caches that
/// can be dropped, or of the disk. kUnknown if the system does not tell.
std::size_t available_memory() {
  std::ifstream lines("/proc/meminfo");  // "MemAvailable:   12345678 kB"
  std::size_t bytes = 0;
  std::string name;
  std::string unit;
  for (std::size_t amount = 0; lines >> name >> amount && std::getline(lines, unit);) {
    constexpr std::size_t kKilobyte = 1024;
    if (name == "MemAvailable:" || name == "SwapFree:") bytes += amount * kKilobyte;
  }
  return bytes == 0 ? kUnknown : bytes;
}

/// What a container may use; kUnknown outside of one.
std::size_t container_memory() {
  std::size_t bytes = 0;
  return std::ifstream("/sys/fs/cgroup/memory.max") >> bytes ? bytes : kUnknown;
}

}  // namespace

LazyMemory::LazyMemory(std::size_t most) {
  // Where addresses are limited (ulimit -v), or memory is promised only if it is there, fewer.
  for (std::size_t size = std::min({most, available_memory(), container_memory()}); size > 0;
       size /= 2) {
    void* const address = ::mmap(nullptr, size, PROT_READ | PROT_WRITE,
                                 MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (address == MAP_FAILED) continue;
    data_ = static_cast<char*>(address);
    size_ = size;
    return;
  }
}

LazyMemory::~LazyMemory() {
  if (data_ != nullptr) ::munmap(data_, size_);
}

LazyMemory::LazyMemory(LazyMemory&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

LazyMemory& LazyMemory::operator=(LazyMemory&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  return *this;
}

}  // namespace rangezip
