#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstdint>

#include "macrotask/cache_line.h"
#include "macrotask/waited_object.h"

namespace macrotask {

class TraceRing;

// Internal: a variable of each pthread, as cheap as there is.
#define MACROTASK_TLS __attribute__((tls_model("initial-exec")))

enum class TaskState {
  kNone,
  kReady,
  kRunning,
  kWaiting,
  kExamined,
  kComplete
};

// Internal: what the library knows of a pthread that runs tasks, for whoever
// looks from outside: the list of tasks, the search for deadlocks, the history
// trace. Never freed, so that one may look at any time.
//
// Use: the owner is the pthread. It publishes a wait only if the wait is long
// (SpinThenSleep), so that this costs nothing where tasks run. Others may look
// at the wait by Examine(), which keeps the owner in it meanwhile.
class alignas(kCacheLine) TaskRecord {
 public:
  using IsOver = bool (*)(const void* wait);

  TaskRecord() = default;
  TaskRecord(const TaskRecord&) = delete;
  TaskRecord& operator=(const TaskRecord&) = delete;

  // By the starter: the pthread will run this task.
  void SetReady(std::uint32_t number, std::uint64_t value);

  // By the owner: it runs the task that was set ready. (That the number is
  // given again makes this a store without a load: the line is the starter's.)
  void SetRunning(std::uint32_t number);

  // By the owner: the task is complete. Does nothing if the next one is ready
  // already.
  void SetComplete();

  // By the owner. `is_over(wait)` must say, to whoever asks and at any time
  // until EndWait() returns, whether the wait has come to its end; once true it
  // stays true.
  void BeginWait(const WaitedObject& what, IsOver is_over, const void* wait);
  void EndWait();

  // The state, and of which wait of which task: the same word twice says that
  // nothing has changed in between.
  struct Word {
    std::uint64_t epoch;  // number of the task << 29 | waits that it has begun
    TaskState state;
    friend bool operator==(const Word&, const Word&) = default;
  };
  Word Read() const;

  // Holds the owner in its wait while `look(what, is_over)` runs. Returns false
  // without looking if the owner is not in a wait, or in another than that of
  // `word`.
  template <typename Look>
  bool Examine(const Word& word, const Look& look);

  std::uint32_t number() const {
    return number_.load(std::memory_order_relaxed);
  }
  std::uint64_t value() const { return value_.load(std::memory_order_relaxed); }
  pid_t pthread_id() const {
    return pthread_id_.load(std::memory_order_acquire);
  }
  TaskRecord* next() const { return next_; }

  // What the search for deadlocks saw in its first pass; its own.
  Word seen{};

  // The owner's part of the history trace; null if it has recorded nothing.
  std::atomic<TraceRing*> trace{nullptr};

 private:
  friend class TaskRegistry;

  static std::uint64_t Pack(const Word& word) {
    return word.epoch << 3 | static_cast<std::uint64_t>(word.state);
  }
  bool Exchange(const Word& from, const Word& to);

  std::atomic<std::uint64_t> word_{0};  // epoch << 3 | state
  std::atomic<std::uint32_t> number_{0};
  std::atomic<std::uint64_t> value_{0};
  std::atomic<pid_t> pthread_id_{0};  // of the system; 0: none
  // Of the wait; written by the owner outside of it, read by others within
  // Examine().
  const WaitedObject* what_ = nullptr;
  IsOver is_over_ = nullptr;
  const void* wait_ = nullptr;
  TaskRecord* next_ = nullptr;       // fixed once it is in the list
  TaskRecord* next_free_ = nullptr;  // guarded by the registry's mutex
};

template <typename Look>
bool TaskRecord::Examine(const Word& word, const Look& look) {
  if (word.state != TaskState::kWaiting) return false;
  const Word examined = {word.epoch, TaskState::kExamined};
  if (!Exchange(word, examined)) return false;
  look(*what_, is_over_(wait_));
  Exchange(examined, word);
  return true;
}

}  // namespace macrotask
