#pragma once

#include "macrotask/task_record.h"

namespace macrotask {

class LogicalProcessor;

// Internal: the processor whose logical task the caller is; null if it is none.
inline constinit thread_local LogicalProcessor* processor_of_caller
    MACROTASK_TLS = nullptr;

// Internal: other tasks of the processor run until `is_over(wait)`, of which
// TaskRecord::BeginWait() says more. Requires: processor_of_caller.
void WaitLogically(const WaitedObject& what, TaskRecord::IsOver is_over,
                   const void* wait);

// Internal: by a task that asks again and again: whoever will change the answer
// may be of the same processor, or want it.
void GiveWay();

}  // namespace macrotask
