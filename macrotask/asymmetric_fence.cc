#include "macrotask/asymmetric_fence.h"

#include <linux/membarrier.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>

#include "macrotask/check.h"

namespace macrotask {
namespace {

// The C library has no function for it.
bool Membarrier(int command) {
  return syscall(SYS_membarrier, command, 0, 0) == 0;
}

// A forked process inherits it. Quick as long as there is one pthread, tens of
// milliseconds later on.
bool Register() {
  return Membarrier(MEMBARRIER_CMD_REGISTER_PRIVATE_EXPEDITED);
}

}  // namespace

const bool has_heavy_fence = Register();

void HeavyFence() noexcept {
  if (Membarrier(MEMBARRIER_CMD_PRIVATE_EXPEDITED)) return;
  CheckPthread(errno, "membarrier");  // Terminates; errno is never 0 here.
}

}  // namespace macrotask
