#include "core/raster/rasterizer.h"

#include <string>

#include "core/base/error.h"

namespace rangezip {
}  // namespace rangezip
