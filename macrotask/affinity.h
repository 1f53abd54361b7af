#pragma once

#include <sched.h>

#include "macrotask/placement.h"

namespace macrotask {

// Internal: the set that holds `processor` alone, or every processor of this
// process for kAnyProcessor.
cpu_set_t AffinityFor(int processor);

// Internal: how often SetMaxProcessors() has changed what AffinityFor() says.
int AffinityVersion();

// Internal: lets the calling pthread run on AffinityFor(processor) only. Says
// whether the system agreed; a processor may have been taken away from this
// process since NumProcessors() looked.
bool MoveCallerTo(int processor);

// Internal: moves the caller to `processor` for the length of a block and gives
// it back the affinity it had, whatever that was. kAnyProcessor leaves it
// alone.
class [[nodiscard]] ScopedProcessor {
 public:
  explicit ScopedProcessor(int processor);
  ~ScopedProcessor();
  ScopedProcessor(const ScopedProcessor&) = delete;
  ScopedProcessor& operator=(const ScopedProcessor&) = delete;

 private:
  bool moved_ = false;
  cpu_set_t before_;  // set iff moved_
};

}  // namespace macrotask
