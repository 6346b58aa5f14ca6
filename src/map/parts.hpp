// Work on many items, shared between the threads that TBB has.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstddef>

namespace nbvopt {

/// Calls run(first, last) for parts of [0, items) of about so many items, at the same time. A
/// thread that waits for the others takes up no work but this: it may hold a lock.
template <class Run>
void for_each_part(std::size_t items, std::size_t items_a_part, const Run& run) {
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, items, items_a_part),
        [&](const tbb::blocked_range<std::size_t>& part) { run(part.begin(), part.end()); });
  });
}

}  // namespace nbvopt
