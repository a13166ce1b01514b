#pragma once

#include <cstddef>
#include <functional>

namespace rangezip {

/// Runs `work` with at most `threads` threads in every parallel loop inside it; 0 means as many
/// as the machine has, and more are not started. Loops outside of any run_with_threads() use all.
/// Exceptions of `work` pass through.
void run_with_threads(int threads, const std::function<void()>& work);

/// Threads that a parallel loop started here may use, at least 1.
[[nodiscard]] int thread_count();

/// Calls body(begin, end) for consecutive blocks of at most `grain` items that together are
/// [0, count), in any order and on any thread. The blocks depend on `count` and `grain` only, so
/// a body that writes only slots of its own block gives the same bits for any number of threads.
/// The first exception of a body is rethrown here.
/// @pre grain >= 1
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t begin, std::size_t end)>& body);

/// Calls both, at the same time if there are two threads; neither may write what the other reads.
void run_side_by_side(const std::function<void()>& one, const std::function<void()>& other);

/// parallel_for over image rows: calls row(y) for each y in [0, height).
void for_each_row(int height, const std::function<void(int y)>& row);

}  // namespace rangezip
