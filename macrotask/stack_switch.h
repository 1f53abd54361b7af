#pragma once

#include <boost/context/detail/fcontext.hpp>

namespace macrotask {

// Internal: goes on where the stack `to` was left, and returns when somebody
// comes back to this one. What it returns, there and here: the stack that was
// left, and `data`.
//
// Cost: that of Boost.Context's jump_fcontext(), and no more than that: see the
// source.
#if defined(__x86_64__)
boost::context::detail::transfer_t SwitchStack(
    boost::context::detail::fcontext_t to,
    void* data) asm("macrotask_switch_stack");
#else
inline boost::context::detail::transfer_t SwitchStack(
    boost::context::detail::fcontext_t to, void* data) {
  return boost::context::detail::jump_fcontext(to, data);
}
#endif

}  // namespace macrotask
