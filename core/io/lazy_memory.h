#pragma once

#include <cstddef>

namespace rangezip {

/// Room for bytes whose number is known only when all are there: addresses are taken for the most
/// there can be, memory as it is written to. Nothing is copied as it fills.
class LazyMemory {
 public:
  LazyMemory() = default;
  /// Room for `most` bytes, or for as many as there are addresses and memory for: no more than
  /// the system says is free. See size().
  /// @pre most > 0
  explicit LazyMemory(std::size_t most);
  ~LazyMemory();
  LazyMemory(LazyMemory&& other) noexcept;
  LazyMemory& operator=(LazyMemory&& other) noexcept;
  LazyMemory(const LazyMemory&) = delete;
  LazyMemory& operator=(const LazyMemory&) = delete;

  [[nodiscard]] char* data() const noexcept { return data_; }
  /// 0 if there is none at all.
  [[nodiscard]] std::size_t size() const noexcept { return size_; }

 private:
  char* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace rangezip
