#pragma once

#include <array>
#include <atomic>
#include <cstdint>

// What the routines for tasks do. Each throws std::runtime_error, the sentence
// without the routine's name, on a bad call.

namespace macrotask::cray {

// The words that TSKSTART hands on to the task: up to 20 integers and addresses,
// then, from Fortran, the lengths of those that are CHARACTER arguments. Words
// that were not given are whatever was in their place.
inline constexpr int kMostWords = 20 + 20;
using Words = std::array<std::uintptr_t, kMostWords>;
using TaskRoutine = void (*)();

// Starts routine(words...). Returns the number of the task, 31 bits.
std::uint32_t StartTask(TaskRoutine routine, const Words& words,
                        std::uint64_t value);

// By number; one that no task has is that of a complete task.
void WaitForTask(std::int64_t number);
bool TestTask(std::int64_t number);

// TSECND: CPU seconds of the calling task.
double CpuSeconds();

// Of the task control array.
template <typename Word>
std::uint64_t UserValueIn(const Word* tca);
template <typename Word>
std::int64_t NumberIn(Word* tca) {
  // The starter may be writing it.
  return std::atomic_ref<Word>(tca[1]).load(std::memory_order_acquire);
}

template <typename Word>
void StartTask(Word* tca, TaskRoutine routine, const Words& words) {
  const std::uint32_t number = StartTask(routine, words, UserValueIn(tca));
  // Release: partner of the acquire in NumberIn().
  std::atomic_ref<Word>(tca[1]).store(static_cast<Word>(number),
                                      std::memory_order_release);
}

}  // namespace macrotask::cray
