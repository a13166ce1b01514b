#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "tests/support/wrong_rasterizers.h"

namespace rangezip {

/// A right rasterizer's images with a fault of the kind that a wrong backend makes: what a judge of
/// drawings has to see. They render only.
[[nodiscard]] std::vector<WrongRasterizer> drawing_faults(
    const std::function<std::unique_ptr<Rasterizer>()>& make_right);

/// One of them: the primitive that is seen in most pixels is left out.
[[nodiscard]] std::unique_ptr<Rasterizer> without_a_primitive(std::unique_ptr<Rasterizer> right);

}  // namespace rangezip
