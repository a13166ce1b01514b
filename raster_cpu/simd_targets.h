#pragma once

// Which of Highway's sets of instructions are compiled, and which of them get kernels. To be
// included before Highway in every file that includes it: tables of functions would differ.
#ifdef HIGHWAY_HWY_DETECT_TARGETS_H_
#error "raster_cpu/simd_targets.h must be included before Highway"
#endif

// Left out: vectors whose length is known only at run time, since they can be no members. ARM has
// NEON beside them.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

// Vectors that are emulated are no faster than scalar code, and the kernels take the lower half of
// a 64-bit lane to come first in memory.
#define RANGEZIP_HAS_VECTORS                               \
  (HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128 && \
   __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__)
