#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/raster/rasterizer.h"

/// Rasterizers that break a rule on purpose: what a comparison of drawings has to notice.
namespace rangezip {

struct WrongRasterizer {
  std::string name;  ///< the wrong rule
  std::function<std::unique_ptr<Rasterizer>()> make;
  bool is_slow = false;  ///< for small images only
};

/// One for each of the oracle's mistakes, and some of the kind that come with threads and vectors,
/// made of a right one.
[[nodiscard]] std::vector<WrongRasterizer> wrong_rasterizers(
    const std::function<std::unique_ptr<Rasterizer>()>& make_right);

}  // namespace rangezip
