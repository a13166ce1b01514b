#include "tests/support/threads.h"

#ifdef RANGEZIP_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#else
#include "core/base/parallel.h"
#endif

namespace rangezip {

#ifdef RANGEZIP_WITH_TBB

void run_with_exactly(int threads, const std::function<void()>& work) {
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute(work);
}

#else

void run_with_exactly(int threads, const std::function<void()>& work) {
  run_with_threads(threads, work);
}

#endif

}  // namespace rangezip
