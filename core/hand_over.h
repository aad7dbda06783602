// What the thread sanitizer has to be told: libtbb is built without it, so it cannot see that a task sees what was
// written before it was spawned, and who waits for it what the task wrote. Only these two orders are told here; what
// two viewers do at the same time stays unordered, so a race between them is reported. Nothing in other builds.
#pragma once

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace gridcull {

#if defined(__SANITIZE_THREAD__)
/// Stands for whoever spawns tasks; a task takes over from it before it reads anything.
inline char spawner;
/// All that this thread did so far is seen by who takes over from `object`.
inline void hand_over(void* object = &spawner) { __tsan_release(object); }
/// From now on this thread sees all that was done before hand_over().
inline void take_over(void* object = &spawner) { __tsan_acquire(object); }
#else
inline void hand_over(void* = nullptr) {}
inline void take_over(void* = nullptr) {}
#endif

}  // namespace gridcull
