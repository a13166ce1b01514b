#pragma once

#include <functional>

namespace rangezip {

/// run_with_threads(), but with as many threads as are asked for on a machine with fewer cores
/// too: a test of eight threads must not become one of two. Without oneTBB (the preset `tsan`) the
/// cores of the machine stay the limit. For the main thread only.
void run_with_exactly(int threads, const std::function<void()>& work);

}  // namespace rangezip
