#include "tests/support/threads.h"

#ifdef RANGEZIP_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <map>
#else
#include "core/base/parallel.h"
#endif

namespace rangezip {

#ifdef RANGEZIP_WITH_TBB

void run_with_exactly(int threads, const std::function<void()>& work) {
  // oneTBB takes no more threads than cores without the first. Both are kept: to make them anew
  // for each of many short drawings wakes threads, and costs five times the drawings.
  constexpr std::size_t kMostThreads = 64;
  static const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                           kMostThreads);
  static std::map<int, tbb::task_arena> arenas;
  arenas.try_emplace(threads, threads).first->second.execute(work);
}

#else

void run_with_exactly(int threads, const std::function<void()>& work) {
  run_with_threads(threads, work);
}

#endif

}  // namespace rangezip
