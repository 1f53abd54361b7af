/* Included by macrotask/cray.h: handles of 32 bits, one name for both widths,
   and arguments that may be left out. */

#pragma once

#ifdef __cplusplus
extern "C" {
#endif

void TSKSTART_32(int* tca, macrotask_routine* task, ...);
void TSKWAIT_32(int* tca);
int TSKTEST_32(int* tca);
void TSKVALUE_32(int* value);
void LOCKASGN_32(int* lock);
void LOCKASGN_IF_32(int* lock, int value);
void LOCKON_32(int* lock);
void LOCKOFF_32(int* lock);
int LOCKTEST_32(int* lock);
void LOCKREL_32(int* lock);
void EVASGN_32(int* event);
void EVASGN_IF_32(int* event, int value);
void EVPOST_32(int* event);
void EVWAIT_32(int* event);
void EVCLEAR_32(int* event);
int EVTEST_32(int* event);
void EVREL_32(int* event);
void BARASGN_32(int* barrier, long num_tasks);
void BARSYNC_32(int* barrier);
void BARREL_32(int* barrier);

#ifdef __cplusplus
} /* extern "C" */
#endif

#ifdef __cplusplus

template <typename... Words>
void TSKSTART(int* tca, macrotask_routine* task, Words... words) {
  TSKSTART_32(tca, task, words...);
}
template <typename Word, typename First, typename... Rest, typename... Words>
void TSKSTART(Word* tca, void (*task)(First, Rest...), Words... words) {
  TSKSTART(tca, reinterpret_cast<macrotask_routine*>(task), words...);
}
inline void TSKWAIT(int* tca) { TSKWAIT_32(tca); }
inline int TSKTEST(int* tca) { return TSKTEST_32(tca); }
inline void TSKVALUE(int* value) { TSKVALUE_32(value); }
inline void LOCKASGN(int* lock) { LOCKASGN_32(lock); }
inline void LOCKASGN(int* lock, int value) { LOCKASGN_IF_32(lock, value); }
inline void LOCKASGN(long* lock, long value) { LOCKASGN_IF(lock, value); }
inline void LOCKON(int* lock) { LOCKON_32(lock); }
inline void LOCKOFF(int* lock) { LOCKOFF_32(lock); }
inline int LOCKTEST(int* lock) { return LOCKTEST_32(lock); }
inline void LOCKREL(int* lock) { LOCKREL_32(lock); }
inline void EVASGN(int* event) { EVASGN_32(event); }
inline void EVASGN(int* event, int value) { EVASGN_IF_32(event, value); }
inline void EVASGN(long* event, long value) { EVASGN_IF(event, value); }
inline void EVPOST(int* event) { EVPOST_32(event); }
inline void EVWAIT(int* event) { EVWAIT_32(event); }
inline void EVCLEAR(int* event) { EVCLEAR_32(event); }
inline int EVTEST(int* event) { return EVTEST_32(event); }
inline void EVREL(int* event) { EVREL_32(event); }
inline void BARASGN(int* barrier, long n) { BARASGN_32(barrier, n); }
inline void BARSYNC(int* barrier) { BARSYNC_32(barrier); }
inline void BARREL(int* barrier) { BARREL_32(barrier); }

#elif defined(__STDC_VERSION__) && __STDC_VERSION__ >= 201112L && \
    !defined(MACROTASK_NO_MACROS)

/* A macro is not expanded within itself: name(...) there is the function. */
#define MACROTASK_BY_WIDTH(handle, name) \
  _Generic((handle), int* : name##_32, default : name)
#define MACROTASK_BY_COUNT(a, b, name, ...) name

/* The cast is of the first argument after tca, the routine. */
#define TSKSTART(tca, ...)          \
  MACROTASK_BY_WIDTH(tca, TSKSTART) \
  (tca, (macrotask_routine*)__VA_ARGS__)
#define TSKWAIT(tca) MACROTASK_BY_WIDTH(tca, TSKWAIT)(tca)
#define TSKTEST(tca) MACROTASK_BY_WIDTH(tca, TSKTEST)(tca)
#define TSKVALUE(value) MACROTASK_BY_WIDTH(value, TSKVALUE)(value)
#define LOCKASGN_1(lock) MACROTASK_BY_WIDTH(lock, LOCKASGN)(lock)
#define LOCKASGN_2(lock, value) \
  MACROTASK_BY_WIDTH(lock, LOCKASGN_IF)(lock, value)
#define LOCKASGN(...) \
  MACROTASK_BY_COUNT(__VA_ARGS__, LOCKASGN_2, LOCKASGN_1, unused)(__VA_ARGS__)
#define LOCKON(lock) MACROTASK_BY_WIDTH(lock, LOCKON)(lock)
#define LOCKOFF(lock) MACROTASK_BY_WIDTH(lock, LOCKOFF)(lock)
#define LOCKTEST(lock) MACROTASK_BY_WIDTH(lock, LOCKTEST)(lock)
#define LOCKREL(lock) MACROTASK_BY_WIDTH(lock, LOCKREL)(lock)
#define EVASGN_1(event) MACROTASK_BY_WIDTH(event, EVASGN)(event)
#define EVASGN_2(event, value) \
  MACROTASK_BY_WIDTH(event, EVASGN_IF)(event, value)
#define EVASGN(...) \
  MACROTASK_BY_COUNT(__VA_ARGS__, EVASGN_2, EVASGN_1, unused)(__VA_ARGS__)
#define EVPOST(event) MACROTASK_BY_WIDTH(event, EVPOST)(event)
#define EVWAIT(event) MACROTASK_BY_WIDTH(event, EVWAIT)(event)
#define EVCLEAR(event) MACROTASK_BY_WIDTH(event, EVCLEAR)(event)
#define EVTEST(event) MACROTASK_BY_WIDTH(event, EVTEST)(event)
#define EVREL(event) MACROTASK_BY_WIDTH(event, EVREL)(event)
#define BARASGN(barrier, n) MACROTASK_BY_WIDTH(barrier, BARASGN)(barrier, n)
#define BARSYNC(barrier) MACROTASK_BY_WIDTH(barrier, BARSYNC)(barrier)
#define BARREL(barrier) MACROTASK_BY_WIDTH(barrier, BARREL)(barrier)

#endif

#if !defined(MACROTASK_NO_MACROS)
#define TSKTUNE(...) TSKTUNE(__VA_ARGS__, (const char*)0)
#endif
