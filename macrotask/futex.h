#pragma once

#include <atomic>
#include <cstdint>

namespace macrotask {

// Internal: sleeping on the lower half of a word, with the system's own means
// (futex(2)).
//
// FutexWait() returns at once if that half is not `seen` (any more), otherwise
// when FutexWakeAll() is called for the word, and now and then for no reason,
// so that it always stands in a loop. Neither touches the word.
//
// Cost: 20 to 30 us to sleep and be woken by another processor, 2 us by a task
// of the same one.
void FutexWait(const std::atomic<std::uint64_t>& word, std::uint32_t seen);
void FutexWakeAll(const std::atomic<std::uint64_t>& word);

}  // namespace macrotask
