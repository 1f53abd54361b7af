#pragma once

// In place of macrotask/mutex.h.

namespace macrotask {

class Mutex {
 private:
  friend class MutexGuard;
  friend class Condition;
  rl::mutex mutex_;
};

class [[nodiscard]] MutexGuard {
 public:
  explicit MutexGuard(Mutex& mutex) : mutex_(mutex) {
    mutex_.mutex_.lock(RL_INFO);
  }
  ~MutexGuard() { mutex_.mutex_.unlock(RL_INFO); }
  MutexGuard(const MutexGuard&) = delete;
  MutexGuard& operator=(const MutexGuard&) = delete;

 private:
  Mutex& mutex_;
};

class Condition {
 public:
  void Wait(Mutex& mutex) { condition_.wait(mutex.mutex_, RL_INFO); }
  void WakeAll() { condition_.notify_all(RL_INFO); }

 private:
  rl::condition_variable condition_;
};

}  // namespace macrotask
