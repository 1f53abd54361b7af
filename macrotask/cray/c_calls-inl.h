// The routines of macrotask/cray.h for one width of handles. To be included
// like calls-inl.h.

#include "macrotask/cray/calls-inl.h"

MACROTASK_ENTRY void MACROTASK_NAME(LOCKASGN_IF, )(Word* lock, Word value) {
  RunCall(MACROTASK_CALL("LOCKASGN"), [&] { AssignLockIf(lock, value); });
}

MACROTASK_ENTRY void MACROTASK_NAME(EVASGN_IF, )(Word* event, Word value) {
  RunCall(MACROTASK_CALL("EVASGN"), [&] { AssignEventIf(event, value); });
}

MACROTASK_ENTRY void MACROTASK_NAME(BARASGN, )(Word* barrier, long num_tasks) {
  RunCall(MACROTASK_CALL("BARASGN"),
          [&] { AssignBarrier(barrier, num_tasks); });
}
