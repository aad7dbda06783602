// Work shared out among threads.
#pragma once

#include <array>
#include <cstddef>

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include "gridcull/core/hand_over.h"

namespace gridcull {

/// f(i, worker) for all i of first .. last - 1, in any order. No two calls with the same `worker`,
/// 0 .. arena.max_concurrency() - 1 (at most 256), run at the same time: it names a scratch.
template <class F>
void for_each_on(tbb::task_arena& arena, std::size_t first, std::size_t last, const F& f) {
  std::array<char, 256> workers{};  // only their addresses count: see hand_over.h
  const auto body = [&](std::size_t i) {
    take_over();
    const auto worker = static_cast<std::size_t>(tbb::this_task_arena::current_thread_index());
    take_over(&workers[worker]);
    f(i, worker);
    hand_over(&workers[worker]);
  };
  hand_over();
  arena.execute([&] { tbb::parallel_for(first, last, body, tbb::simple_partitioner()); });
  for (char& worker : workers) take_over(&worker);
}

}  // namespace gridcull
