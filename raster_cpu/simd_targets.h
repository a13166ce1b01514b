#pragma once

// Which of Highway's sets of instructions are compiled; to be included before Highway.
// Left out: vectors whose length is known only at run time, since they can be no members. ARM has
// NEON beside them.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
