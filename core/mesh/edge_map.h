#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace rangezip {

/// Finds the face that has a directed edge (from, to) in its counter-clockwise border. In an
/// oriented manifold mesh each directed edge belongs to one face, and the face across edge
/// (a, b) is the one with (b, a).
///
/// Open addressing in flat arrays: one cache line for most look-ups, 12 bytes times at most four
/// per edge, the same content for the same calls on every machine. Grows when it must; a good
/// `expected_edges` (3 a face) saves that.
class EdgeMap {
 public:
  static constexpr std::uint32_t kNone = 0xffff'ffffU;

  explicit EdgeMap(std::size_t expected_edges = 0) { reset(capacity_for(expected_edges)); }

  /// The face of the edge, or kNone.
  [[nodiscard]] std::uint32_t find(std::uint32_t from, std::uint32_t to) const noexcept {
    const std::size_t slot = slot_of(key_of(from, to));
    return keys_[slot] == kFree ? kNone : faces_[slot];
  }

  /// Enters an edge; false, and no change, if it is already there.
  /// @pre face != kNone, and not both corners are kNone
  bool insert(std::uint32_t from, std::uint32_t to, std::uint32_t face) {
    const std::uint64_t key = key_of(from, to);
    std::size_t slot = slot_of(key);
    if (keys_[slot] == kFree) {
      if (2 * (used_slots_ + 1) > keys_.size()) {
        rehash();
        slot = slot_of(key);
      }
      keys_[slot] = key;
      ++used_slots_;
    } else if (faces_[slot] != kNone) {
      return false;
    }
    faces_[slot] = face;
    ++edges_;
    return true;
  }

  /// Removes an edge; nothing happens if it is not there.
  void erase(std::uint32_t from, std::uint32_t to) noexcept {
    const std::size_t slot = slot_of(key_of(from, to));
    if (keys_[slot] == kFree || faces_[slot] == kNone) return;
    faces_[slot] = kNone;  // the key stays, so that probes still walk past this slot
    --edges_;
  }

  /// Number of edges entered.
  [[nodiscard]] std::size_t size() const noexcept { return edges_; }

 private:
  static constexpr std::uint64_t kFree = ~std::uint64_t{0};

  static std::uint64_t key_of(std::uint32_t from, std::uint32_t to) noexcept {
    return (std::uint64_t{from} << 32) | to;
  }

  static std::size_t capacity_for(std::size_t edges) noexcept {
    std::size_t capacity = 16;
    while (capacity < 2 * edges)
      capacity *= 2;
    return capacity;
  }

  void reset(std::size_t capacity) {
    keys_.assign(capacity, kFree);
    faces_.assign(capacity, kNone);
    used_slots_ = 0;
    edges_ = 0;
  }

  /// Where the key is, or the free slot where it would go.
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const noexcept {
    constexpr std::uint64_t kGoldenRatio = 0x9e37'79b9'7f4a'7c15U;  // Knuth's multiplicative hash
    constexpr int kWellMixedBits = 20;  // the low bits of the product depend on few key bits
    const std::size_t last = keys_.size() - 1;
    std::size_t slot = static_cast<std::size_t>((key * kGoldenRatio) >> kWellMixedBits) & last;
    while (keys_[slot] != kFree && keys_[slot] != key)
      slot = (slot + 1) & last;
    return slot;
  }

  /// Makes room for twice the present edges and forgets erased ones.
  void rehash() {
    const std::vector<std::uint64_t> keys = std::move(keys_);
    const std::vector<std::uint32_t> faces = std::move(faces_);
    reset(capacity_for(2 * (edges_ + 1)));
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (keys[i] == kFree || faces[i] == kNone) continue;
      const std::size_t slot = slot_of(keys[i]);
      keys_[slot] = keys[i];
      faces_[slot] = faces[i];
      ++used_slots_;
      ++edges_;
    }
  }

  std::vector<std::uint64_t> keys_;
  std::vector<std::uint32_t> faces_;
  std::size_t used_slots_ = 0;  ///< with a key, erased ones included
  std::size_t edges_ = 0;
};

}  // namespace rangezip
