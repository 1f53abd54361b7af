// The routines that C and Fortran call in the same way. To be included, within
// namespace macrotask::cray, by a source that has defined Word, the type of
// handles; Logical, that of truth values; and MACROTASK_NAME(UPPER, lower), the
// symbol.

// An entry that C and Fortran link to.
#undef MACROTASK_ENTRY
#define MACROTASK_ENTRY extern "C"

MACROTASK_ENTRY MACROTASK_LOOKS_AT_MORE_WORDS void MACROTASK_NAME(
    TSKSTART, tskstart)(Word* tca, macrotask_routine* task, ...) {
  Words words;
  va_list rest;
  va_start(rest, task);
  // How many there are is not known; with the calling conventions of x86-64
  // Linux one may look at, and hand on, more than there are.
  for (std::uintptr_t& word : words) word = va_arg(rest, std::uintptr_t);
  va_end(rest);
  RunCall(MACROTASK_CALL("TSKSTART"), [&] { StartTask(tca, task, words); });
}

MACROTASK_ENTRY void MACROTASK_NAME(TSKWAIT, tskwait)(Word* tca) {
  RunCall(MACROTASK_CALL("TSKWAIT"), [&] { WaitForTask(NumberIn(tca)); });
}

MACROTASK_ENTRY Logical MACROTASK_NAME(TSKTEST, tsktest)(Word* tca) {
  return RunCall(MACROTASK_CALL("TSKTEST"),
                 [&] { return TestTask(NumberIn(tca)) ? 1 : 0; });
}

MACROTASK_ENTRY void MACROTASK_NAME(TSKVALUE, tskvalue)(Word* value) {
  *value = static_cast<Word>(Task::Value());
}

MACROTASK_ENTRY void MACROTASK_NAME(LOCKASGN, lockasgn)(Word* lock) {
  RunCall(MACROTASK_CALL("LOCKASGN"), [&] { AssignLock(lock); });
}

MACROTASK_ENTRY void MACROTASK_NAME(LOCKON, lockon)(Word* lock) {
  RunCall(MACROTASK_CALL("LOCKON"), [&] { LockOf(ReadHandle(lock)).On(); });
}

MACROTASK_ENTRY void MACROTASK_NAME(LOCKOFF, lockoff)(Word* lock) {
  RunCall(MACROTASK_CALL("LOCKOFF"), [&] { LockOf(ReadHandle(lock)).Off(); });
}

MACROTASK_ENTRY Logical MACROTASK_NAME(LOCKTEST, locktest)(Word* lock) {
  return RunCall(MACROTASK_CALL("LOCKTEST"),
                 [&] { return LockOf(ReadHandle(lock)).Test() ? 1 : 0; });
}

MACROTASK_ENTRY void MACROTASK_NAME(LOCKREL, lockrel)(Word* lock) {
  RunCall(MACROTASK_CALL("LOCKREL"), [&] { ReleaseLock(ReadHandle(lock)); });
}

MACROTASK_ENTRY void MACROTASK_NAME(EVASGN, evasgn)(Word* event) {
  RunCall(MACROTASK_CALL("EVASGN"), [&] { AssignEvent(event); });
}

MACROTASK_ENTRY void MACROTASK_NAME(EVPOST, evpost)(Word* event) {
  RunCall(MACROTASK_CALL("EVPOST"), [&] { EventOf(ReadHandle(event)).Post(); });
}

MACROTASK_ENTRY void MACROTASK_NAME(EVWAIT, evwait)(Word* event) {
  RunCall(MACROTASK_CALL("EVWAIT"), [&] { EventOf(ReadHandle(event)).Wait(); });
}

MACROTASK_ENTRY void MACROTASK_NAME(EVCLEAR, evclear)(Word* event) {
  RunCall(MACROTASK_CALL("EVCLEAR"),
          [&] { EventOf(ReadHandle(event)).Clear(); });
}

MACROTASK_ENTRY Logical MACROTASK_NAME(EVTEST, evtest)(Word* event) {
  return RunCall(MACROTASK_CALL("EVTEST"),
                 [&] { return EventOf(ReadHandle(event)).Test() ? 1 : 0; });
}

MACROTASK_ENTRY void MACROTASK_NAME(EVREL, evrel)(Word* event) {
  RunCall(MACROTASK_CALL("EVREL"), [&] { ReleaseEvent(ReadHandle(event)); });
}

MACROTASK_ENTRY void MACROTASK_NAME(BARSYNC, barsync)(Word* barrier) {
  RunCall(MACROTASK_CALL("BARSYNC"),
          [&] { BarrierOf(ReadHandle(barrier)).Sync(); });
}

MACROTASK_ENTRY void MACROTASK_NAME(BARREL, barrel)(Word* barrier) {
  RunCall(MACROTASK_CALL("BARREL"),
          [&] { ReleaseBarrier(ReadHandle(barrier)); });
}
