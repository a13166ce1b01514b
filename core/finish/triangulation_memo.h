#pragma once

#include <map>
#include <mutex>
#include <vector>

#include "core/finish/loop_triangulation.h"

namespace rangezip {

/// Remembers what triangulate_loop() gave. A repair asks for the same loop when it chooses a fill,
/// when it makes one, and again in every round in which the loop stays open; of a terrain with long
/// borders two thirds of the time went into that.
/// May be used from several threads. Holds some 100 bytes an edge of each different loop.
class TriangulationMemo {
 public:
  /// triangulate_loop(shape).
  /// @pre all shapes that know of air know it of the same cloud
  [[nodiscard]] std::vector<Triangle> triangulate(const LoopShape& shape);

 private:
  std::mutex mutex_;
  std::map<std::vector<double>, std::vector<Triangle>> known_;  ///< by all that a shape holds
};

/// By the memo if there is one.
[[nodiscard]] std::vector<Triangle> triangulate_loop(const LoopShape& shape,
                                                     TriangulationMemo* memo);

}  // namespace rangezip
