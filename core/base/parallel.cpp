#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#ifdef RANGEZIP_WITH_TBB
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace rangezip {

#ifdef RANGEZIP_WITH_TBB

namespace {

/// Of the cores that the process may use, which std::thread does not ask.
int machine_threads() {
  return std::max(1, tbb::info::default_concurrency());
}

}  // namespace

void run_with_threads(int threads, const std::function<void()>& work) {
  // More threads than cores gain nothing, and oneTBB complains about them on the error stream.
  tbb::task_arena arena(threads > 0 ? std::min(threads, machine_threads()) : machine_threads());
  arena.execute(work);
}

int thread_count() {
  return std::max(1, tbb::this_task_arena::max_concurrency());
}

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  const std::size_t blocks = (count + grain - 1) / grain;
  if (blocks <= 1 || thread_count() == 1) {
    for (std::size_t block = 0; block < blocks; ++block) {
      body(block * grain, std::min(count, (block + 1) * grain));
    }
    return;
  }
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
    body(block * grain, std::min(count, (block + 1) * grain));
  });
}

#else

// ThreadSanitizer does not understand oneTBB's synchronisation and reports false races, so its
// preset builds this plain version.
namespace {

thread_local int allowed_threads = 0;

int machine_threads() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace

void run_with_threads(int threads, const std::function<void()>& work) {
  struct Restore {
    int before = allowed_threads;
    ~Restore() { allowed_threads = before; }
  } restore;
  allowed_threads = std::min(threads, machine_threads());
  work();
}

int thread_count() {
  return allowed_threads > 0 ? allowed_threads : machine_threads();
}

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
  const std::size_t blocks = (count + grain - 1) / grain;
  const std::size_t workers = std::min(blocks, static_cast<std::size_t>(thread_count()));
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto drain = [&] {
    try {
      for (std::size_t block = next++; block < blocks; block = next++) {
        body(block * grain, std::min(count, (block + 1) * grain));
      }
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      if (!failure) failure = std::current_exception();
      next = blocks;
    }
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t worker = 1; worker < workers; ++worker) {
      threads.emplace_back([&] {
        allowed_threads = 1;  // a nested loop must not multiply the threads
        drain();
      });
    }
    drain();
  }
  if (failure) std::rethrow_exception(failure);
}

#endif

void run_side_by_side(const std::function<void()>& one, const std::function<void()>& other) {
  parallel_for(2, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      i == 0 ? one() : other();
  });
}

void for_each_row(int height, const std::function<void(int)>& row) {
  constexpr std::size_t kRowsPerBlock = 8;
  parallel_for(static_cast<std::size_t>(std::max(0, height)), kRowsPerBlock,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t y = begin; y < end; ++y)
                   row(static_cast<int>(y));
               });
}

}  // namespace rangezip
