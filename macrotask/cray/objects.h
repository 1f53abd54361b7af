#pragma once

#include <atomic>
#include <cstdint>

#include "macrotask/barrier.h"
#include "macrotask/event.h"
#include "macrotask/lock.h"

// What the routines for locks, events and barriers do, for callers whose
// integers, and handles, are of the type Word: std::int32_t or std::int64_t.
// Each throws std::runtime_error, the sentence without the routine's name, on a
// bad call.

namespace macrotask::cray {

// The handle's place is the caller's; other tasks may be looking at it.
template <typename Word>
std::int64_t ReadHandle(Word* variable) {
  // Acquire: partner of the release in WriteHandle().
  return std::atomic_ref<Word>(*variable).load(std::memory_order_acquire);
}
template <typename Word>
void WriteHandle(Word* variable, std::uint32_t handle) {
  std::atomic_ref<Word>(*variable).store(static_cast<Word>(handle),
                                         std::memory_order_release);
}

// The object of a handle. Throws if there is none.
Lock& LockOf(std::int64_t handle);
Event& EventOf(std::int64_t handle);
Barrier& BarrierOf(std::int64_t handle);

// What the handle in the variable must be after the call; 0 if it was released.
// `old` is what is in it now.
std::uint32_t AssignLock(std::int64_t old);
std::uint32_t AssignEvent(std::int64_t old);
std::uint32_t AssignBarrier(std::int64_t old, std::int64_t num_tasks);
void ReleaseLock(std::int64_t handle);
void ReleaseEvent(std::int64_t handle);
void ReleaseBarrier(std::int64_t handle);

// Held over the look at a variable and its assignment.
Mutex& AssignMutex();

template <typename Word>
void AssignLock(Word* lock) {
  const MutexGuard guard(AssignMutex());
  WriteHandle(lock, AssignLock(ReadHandle(lock)));
}

// Assigns only if the variable still has this value; says whether it did.
template <typename Word>
bool AssignLockIf(Word* lock, Word value) {
  const MutexGuard guard(AssignMutex());
  if (ReadHandle(lock) != value) return false;
  WriteHandle(lock, AssignLock(std::int64_t{value}));
  return true;
}

template <typename Word>
void AssignEvent(Word* event) {
  const MutexGuard guard(AssignMutex());
  WriteHandle(event, AssignEvent(ReadHandle(event)));
}

template <typename Word>
bool AssignEventIf(Word* event, Word value) {
  const MutexGuard guard(AssignMutex());
  if (ReadHandle(event) != value) return false;
  WriteHandle(event, AssignEvent(std::int64_t{value}));
  return true;
}

template <typename Word>
void AssignBarrier(Word* barrier, std::int64_t num_tasks) {
  const MutexGuard guard(AssignMutex());
  WriteHandle(barrier, AssignBarrier(ReadHandle(barrier), num_tasks));
}

}  // namespace macrotask::cray
