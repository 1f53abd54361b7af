#pragma once

#include <system_error>

namespace macrotask {

// Throws std::system_error that names `call` if `error`, the value returned by
// a pthread function, is not 0. These functions return their error and leave
// errno alone, so that a comparison with -1 never fires.
//
//   CheckPthread(pthread_mutex_lock(&mutex), "pthread_mutex_lock");
inline void CheckPthread(int error, const char* call) {
  if (error == 0) return;
  throw std::system_error(error, std::generic_category(), call);
}

}  // namespace macrotask
