#pragma once

#include <cstddef>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define MACROTASK_ADDRESS_SANITIZER 1
#endif
#if __has_feature(thread_sanitizer)
#define MACROTASK_THREAD_SANITIZER 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#define MACROTASK_ADDRESS_SANITIZER 1
#endif
#if defined(__SANITIZE_THREAD__)
#define MACROTASK_THREAD_SANITIZER 1
#endif

#ifdef MACROTASK_ADDRESS_SANITIZER
#include <sanitizer/common_interface_defs.h>
#endif
#ifdef MACROTASK_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace macrotask {

// Internal: tells AddressSanitizer and ThreadSanitizer which stack runs. Empty
// without them.
class FiberAnnotations {
 public:
  // Of a fiber that is made; of the stack that the caller runs on.
  void Make() {
#ifdef MACROTASK_THREAD_SANITIZER
    tsan_ = __tsan_create_fiber(0);
#endif
  }
  void Adopt() {
#ifdef MACROTASK_THREAD_SANITIZER
    tsan_ = __tsan_get_current_fiber();
#endif
  }

  // Right before the switch from this one to `to`, and right after a switch to
  // this one.
  void Leave([[maybe_unused]] const FiberAnnotations& to) {
#ifdef MACROTASK_ADDRESS_SANITIZER
    __sanitizer_start_switch_fiber(&fake_stack_, to.bottom_, to.size_);
#endif
#ifdef MACROTASK_THREAD_SANITIZER
    __tsan_switch_to_fiber(to.tsan_, 0);
#endif
  }
  void Enter([[maybe_unused]] FiberAnnotations* from) {
#ifdef MACROTASK_ADDRESS_SANITIZER
    __sanitizer_finish_switch_fiber(fake_stack_, &from->bottom_, &from->size_);
#endif
  }

 private:
#ifdef MACROTASK_ADDRESS_SANITIZER
  void* fake_stack_ = nullptr;
  const void* bottom_ = nullptr;
  std::size_t size_ = 0;

 public:
  void SetStack(const void* bottom, std::size_t size) {
    bottom_ = bottom;
    size_ = size;
  }
#else
 public:
  void SetStack(const void*, std::size_t) {}
#endif
#ifdef MACROTASK_THREAD_SANITIZER
 private:
  void* tsan_ = nullptr;
#endif
};

}  // namespace macrotask
