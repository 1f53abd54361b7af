// The memory orders by which waits are published and searched, by relacy.

#include "macrotask/task_record.cc"
//
#include "macrotask/deadlock.cc"
#include "tests/models/checked/check.h"

namespace macrotask {
namespace {

// What DetectDeadlock() needs of the program under check.
Mutex* examine_mutex = nullptr;
bool alarm;

}  // namespace

Mutex& ExamineMutex() { return *examine_mutex; }
TaskStatus StatusOf(const TaskRecord& record, const TaskRecord::Word& word) {
  return {record.number(), 0, word.state};
}
void NoteWait(const WaitedObject&, TaskStatus*) {}
void SortByNumber(std::vector<TaskStatus>*) {}
std::string FindCycle(const std::vector<TaskStatus>&) { return ""; }
std::string ToString(const std::vector<TaskStatus>&) { return ""; }
void StopProgram(const std::string&, int) { alarm = true; }

namespace {

const WaitedObject kObject;

// One for each of the tasks; all run.
template <int num_tasks>
struct Records {
  TaskRecord records[num_tasks];
  Mutex mutex;

  void Begin() {
    examine_mutex = &mutex;
    alarm = false;
    TaskRegistry::TheOne().Clear();
    for (TaskRecord& record : records) {
      TaskRegistry::TheOne().Add(&record);
      TaskRegistry::Adopt(&record);
      record.SetReady(1, 0);
      record.SetRunning(1);
    }
  }
};

template <typename Done>
void Wait(TaskRecord& record, const Done& done) {
  record.BeginWait(
      kObject,
      [](const void* wait) { return (*static_cast<const Done*>(wait))(); },
      &done);
  DetectDeadlock();
  while (!done() && !alarm) rl::yield(1, RL_INFO);
  record.EndWait();
}

// Two tasks begin to wait for ever at the same time: one of them must find it.
struct OneOfTwoFindsIt : rl::test_suite<OneOfTwoFindsIt, 2> {
  static constexpr int kNumRuns = 10000;

  Records<2> all;

  void before() { all.Begin(); }
  void thread(unsigned task) {
    Wait(all.records[task], [] { return false; });
  }
  void after() { RL_ASSERT(alarm); }
};

// One task begins to wait when the other one ends.
struct OneEnds : rl::test_suite<OneEnds, 2> {
  static constexpr int kNumRuns = 10000;

  Records<2> all;

  void before() { all.Begin(); }
  void thread(unsigned task) {
    if (task == 0) {
      Wait(all.records[task], [] { return false; });
    } else {
      all.records[task].SetComplete();
      DetectDeadlock();
    }
  }
  void after() { RL_ASSERT(alarm); }
};

// Each of two tasks waits for what the other one has done, or does after a wait
// of its own: there is no deadlock, and a search finds none. The search reads
// what the waiting task has written on its stack.
struct NoFalseAlarm : rl::test_suite<NoFalseAlarm, 2> {
  static constexpr int kNumRuns = 10000;

  Records<2> all;
  checked::UncheckedAtomic<int> turns[2] = {0, 0};

  void before() { all.Begin(); }
  void thread(unsigned task) {
    checked::UncheckedAtomic<int>& mine = turns[task];
    checked::UncheckedAtomic<int>& others = turns[1 - task];
    for (int turn = 1; turn <= 2; ++turn) {
      if (task == 0) mine.store(turn, rl::mo_release, RL_INFO);
      rl::var<int> on_the_stack;
      on_the_stack(RL_INFO) = turn;
      Wait(all.records[task], [&] {
        RL_ASSERT(on_the_stack(RL_INFO) == turn);
        return others.load(rl::mo_acquire, RL_INFO) >= turn;
      });
      if (task == 1) mine.store(turn, rl::mo_release, RL_INFO);
    }
    all.records[task].SetComplete();
  }
  void after() { RL_ASSERT(!alarm); }
};

// A task starts another one, whose pthread was idle, and waits for its end; a
// third one waits for what it does. That the task is in flight, and what its
// number and value are, is known to whoever looks.
struct InFlight : rl::test_suite<InFlight, 3> {
  static constexpr int kNumRuns = 10000;
  static constexpr std::uint32_t kNumber = 7;

  Records<3> all;
  checked::UncheckedAtomic<int> is_given{0};
  checked::UncheckedAtomic<int> is_done{0};

  void before() {
    all.Begin();
    all.records[1].SetComplete();
  }

  void thread(unsigned task) {
    TaskRecord& mine = all.records[task];
    const auto done = [&] {
      return is_done.load(rl::mo_acquire, RL_INFO) == 1;
    };
    if (task == 0) {
      all.records[1].SetReady(kNumber, 1);
      is_given.store(1, rl::mo_release, RL_INFO);
      Wait(mine, done);
    } else if (task == 1) {
      while (is_given.load(rl::mo_acquire, RL_INFO) == 0) rl::yield(1, RL_INFO);
      mine.SetRunning(kNumber);
      is_done.store(1, rl::mo_release, RL_INFO);
      mine.SetComplete();
      DetectDeadlock();
    } else {
      if (all.records[1].Read().epoch >> 29 == kNumber) {
        RL_ASSERT(all.records[1].number() == kNumber);
        RL_ASSERT(all.records[1].value() == 1);
      }
      Wait(mine, done);
    }
  }

  void after() { RL_ASSERT(!alarm); }
};

// A pthread of which the library knows nothing yet becomes a task, by a record
// that another one has left, and does what the first task waits for. It is the
// only pthread that the system lists, so that this task is taken to be known.
struct StrangerArrives : rl::test_suite<StrangerArrives, 2> {
  static constexpr int kNumRuns = 10000;

  TaskRecord waiting;
  TaskRecord left;
  Mutex mutex;
  checked::UncheckedAtomic<int> is_done{0};

  void before() {
    examine_mutex = &mutex;
    alarm = false;
    TaskRegistry::TheOne().Clear();
    TaskRegistry::TheOne().Add(&left);
    waiting.SetReady(1, 0);
    waiting.SetRunning(1);
    TaskRegistry::TheOne().Add(&waiting);
  }

  void thread(unsigned task) {
    if (task == 0) {
      Wait(waiting, [&] { return is_done.load(rl::mo_acquire, RL_INFO) == 1; });
    } else {
      left.SetReady(2, 0);
      left.SetRunning(2);
      TaskRegistry::Adopt(&left);
      is_done.store(1, rl::mo_release, RL_INFO);
    }
  }

  void after() { RL_ASSERT(!alarm); }
};

}  // namespace
}  // namespace macrotask

int main() {
  using namespace macrotask;
  return checked::Check(
      {
          &checked::Search<OneOfTwoFindsIt>,
          &checked::Search<OneEnds>,
          &checked::Search<NoFalseAlarm>,
          &checked::Search<InFlight>,
          &checked::Search<StrangerArrives>,
      },
      // Nobody reads on after an exchange that has failed.
      {"Exchange() failure seq_cst -> acquire"});
}
