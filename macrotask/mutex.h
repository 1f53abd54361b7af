#pragma once

#include <pthread.h>

#include "macrotask/check.h"
#include "macrotask/program_end.h"

namespace macrotask {

// Internal: what a sleeping task sleeps on. pthread_mutex_t with its errors
// checked.
class Mutex {
 public:
  Mutex() {
    CheckPthread(pthread_mutex_init(&mutex_, nullptr), "pthread_mutex_init");
  }
  ~Mutex() {
    // Those who sleep would come back to it.
    if (!caller_stops_program) pthread_mutex_destroy(&mutex_);
  }
  Mutex(const Mutex&) = delete;
  Mutex& operator=(const Mutex&) = delete;

 private:
  friend class MutexGuard;
  friend class Condition;
  pthread_mutex_t mutex_;
};

// Internal: holds a Mutex for the length of a block.
class [[nodiscard]] MutexGuard {
 public:
  explicit MutexGuard(Mutex& mutex) : mutex_(mutex) {
    CheckPthread(pthread_mutex_lock(&mutex_.mutex_), "pthread_mutex_lock");
  }
  ~MutexGuard() { pthread_mutex_unlock(&mutex_.mutex_); }
  MutexGuard(const MutexGuard&) = delete;
  MutexGuard& operator=(const MutexGuard&) = delete;

 private:
  Mutex& mutex_;
};

// Internal: pthread_cond_t with its errors checked. Wait() wakes up for no
// reason now and then, so that it always stands in a loop.
class Condition {
 public:
  Condition() {
    CheckPthread(pthread_cond_init(&condition_, nullptr), "pthread_cond_init");
  }
  ~Condition() {
    // It would wait for those who sleep.
    if (!caller_stops_program) pthread_cond_destroy(&condition_);
  }
  Condition(const Condition&) = delete;
  Condition& operator=(const Condition&) = delete;

  // Requires: the caller holds `mutex` by a MutexGuard.
  void Wait(Mutex& mutex) {
    CheckPthread(pthread_cond_wait(&condition_, &mutex.mutex_),
                 "pthread_cond_wait");
  }
  void WakeAll() {
    CheckPthread(pthread_cond_broadcast(&condition_), "pthread_cond_broadcast");
  }

 private:
  pthread_cond_t condition_;
};

}  // namespace macrotask
