#include "macrotask/cray/objects.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "macrotask/cray/handle_table.h"
#include "macrotask/cray/tuning.h"
#include "macrotask/task_list.h"
#include "macrotask/trace_point.h"

namespace macrotask::cray {
namespace {

// Everything here is made once and never destroyed, because tasks may live
// longer than static objects.
struct Tables {
  HandleTable<Lock> locks{HandleKind::kLock};
  HandleTable<Event> events{HandleKind::kEvent};
  HandleTable<Barrier> barriers{HandleKind::kBarrier};

  // Released objects, to be assigned again. A task may still be on its way out
  // of one, which does no harm: nothing that it does there depends on who has
  // the object by then. By number of tasks for barriers.
  std::vector<Lock*> free_locks;
  std::vector<Event*> free_events;
  std::multimap<int, Barrier*> free_barriers;
};

Tables& TheTables() {
  static Tables* const tables = new Tables;
  return *tables;
}

// Whether the object's tasks wait as is wanted now.
template <typename Object>
bool IsTuned(const Object& object) {
  return object.policy() == TunedPolicy();
}

// A free object, the last that was released first, or a new one.
template <typename Object>
Object* TakeFree(std::vector<Object*>* free) {
  const auto found =
      std::find_if(free->rbegin(), free->rend(),
                   [](const Object* one) { return IsTuned(*one); });
  if (found == free->rend()) return new Object(TunedPolicy());
  Object* const taken = *found;
  free->erase(std::next(found).base());
  return taken;
}

Barrier* TakeBarrier(int num_tasks, Tables* tables) {
  auto [found, end] = tables->free_barriers.equal_range(num_tasks);
  while (found != end && !IsTuned(*found->second)) ++found;
  if (found == end) return new Barrier(num_tasks, TunedPolicy());
  Barrier* const taken = found->second;
  tables->free_barriers.erase(found);
  return taken;
}

// What is wrong with a handle that names nothing.
template <typename Object>
[[noreturn]] void FailHandle(const HandleTable<Object>& table,
                             std::int64_t handle, const std::string& noun,
                             const std::string& assigned_by) {
  const Tables& tables = TheTables();
  std::string what;
  if (table.WasReleased(handle)) {
    what = "the " + noun + " of this variable was released";
  } else if (tables.locks.Find(handle) != nullptr) {
    what = "the variable holds a lock";
  } else if (tables.events.Find(handle) != nullptr) {
    what = "the variable holds an event";
  } else if (tables.barriers.Find(handle) != nullptr) {
    what = "the variable holds a barrier";
  } else {
    what = "the variable holds " + std::to_string(handle);
  }
  throw std::runtime_error(what + ": expected " + assigned_by);
}

std::string Tasks(int number) {
  return std::to_string(number) + (number == 1 ? " task waits" : " tasks wait");
}

int NumWaitingFor(const Event& event) {
  int number = 0;
  for (const TaskStatus& task : ListTasks()) {
    if (task.state == TaskState::kWaiting &&
        task.waits_for == ObjectKind::kEvent && task.object == event.number()) {
      ++number;
    }
  }
  return number;
}

void CheckNobodyWaits(int num_waiting, const char* where) {
  if (num_waiting == 0) return;
  throw std::runtime_error(Tasks(num_waiting) + " " + where);
}

}  // namespace

Mutex& AssignMutex() {
  static Mutex* const mutex = new Mutex;
  return *mutex;
}

Lock& LockOf(std::int64_t handle) {
  const auto& table = TheTables().locks;
  Lock* const lock = table.Find(handle);
  if (lock == nullptr) {
    FailHandle(table, handle, "lock", "a lock, assigned by LOCKASGN");
  }
  return *lock;
}

Event& EventOf(std::int64_t handle) {
  const auto& table = TheTables().events;
  Event* const event = table.Find(handle);
  if (event == nullptr) {
    FailHandle(table, handle, "event", "an event, assigned by EVASGN");
  }
  return *event;
}

Barrier& BarrierOf(std::int64_t handle) {
  const auto& table = TheTables().barriers;
  Barrier* const barrier = table.Find(handle);
  if (barrier == nullptr) {
    FailHandle(table, handle, "barrier", "a barrier, assigned by BARASGN");
  }
  return *barrier;
}

std::uint32_t AssignLock(std::int64_t old) {
  Tables& tables = TheTables();
  auto handle = static_cast<std::uint32_t>(old);
  Lock* lock = tables.locks.Find(old);
  if (lock == nullptr) {
    tables.locks.CheckRoom();
    lock = TakeFree(&tables.free_locks);
    handle = tables.locks.Assign(lock);
  } else {
    CheckNobodyWaits(lock->num_waiting(), "for the lock");
    if (!IsTuned(*lock)) {
      Lock* const before = std::exchange(lock, TakeFree(&tables.free_locks));
      tables.locks.Replace(old, lock);
      tables.free_locks.push_back(before);
    }
  }
  RecordIf(TraceClass::kLocks, TraceAction::kLockAssign,
           TraceData(lock->number()));
  if (lock->is_set()) lock->Off();
  return handle;
}

std::uint32_t AssignEvent(std::int64_t old) {
  Tables& tables = TheTables();
  auto handle = static_cast<std::uint32_t>(old);
  Event* event = tables.events.Find(old);
  if (event == nullptr) {
    tables.events.CheckRoom();
    event = TakeFree(&tables.free_events);
    handle = tables.events.Assign(event);
  } else if (!IsTuned(*event) && NumWaitingFor(*event) == 0) {
    Event* const before = std::exchange(event, TakeFree(&tables.free_events));
    tables.events.Replace(old, event);
    tables.free_events.push_back(before);
  }
  RecordIf(TraceClass::kEvents, TraceAction::kEventAssign,
           TraceData(event->number()));
  event->Clear();
  return handle;
}

std::uint32_t AssignBarrier(std::int64_t old, std::int64_t num_tasks) {
  constexpr std::int64_t kMostTasks = 1'000'000;
  if (num_tasks < 1 || num_tasks > kMostTasks) {
    throw std::runtime_error("a barrier of " + std::to_string(num_tasks) +
                             " tasks: expected 1 to " +
                             std::to_string(kMostTasks));
  }
  Tables& tables = TheTables();
  auto handle = static_cast<std::uint32_t>(old);
  Barrier* const before = tables.barriers.Find(old);
  if (before != nullptr) {
    CheckNobodyWaits(before->num_waiting(), "at the barrier");
  }
  if (before == nullptr) tables.barriers.CheckRoom();
  Barrier* const barrier = TakeBarrier(static_cast<int>(num_tasks), &tables);
  if (before != nullptr) {
    tables.barriers.Replace(old, barrier);
    tables.free_barriers.emplace(before->num_tasks(), before);
  } else {
    handle = tables.barriers.Assign(barrier);
  }
  RecordIf(TraceClass::kEvents, TraceAction::kBarrierAssign,
           TraceData(barrier->number(), static_cast<std::uint64_t>(num_tasks)));
  return handle;
}

void ReleaseLock(std::int64_t handle) {
  const MutexGuard guard(AssignMutex());
  Lock& lock = LockOf(handle);
  if (lock.is_set()) {
    const std::uint32_t holder = lock.holder();
    throw std::runtime_error(holder == 0 ? "the lock is set"
                                         : "the lock is set, by task " +
                                               std::to_string(holder));
  }
  RecordIf(TraceClass::kLocks, TraceAction::kLockRelease,
           TraceData(lock.number()));
  TheTables().locks.Release(handle);
  TheTables().free_locks.push_back(&lock);
}

void ReleaseEvent(std::int64_t handle) {
  const MutexGuard guard(AssignMutex());
  Event& event = EventOf(handle);
  CheckNobodyWaits(NumWaitingFor(event), "for the event");
  RecordIf(TraceClass::kEvents, TraceAction::kEventRelease,
           TraceData(event.number()));
  TheTables().events.Release(handle);
  TheTables().free_events.push_back(&event);
}

void ReleaseBarrier(std::int64_t handle) {
  const MutexGuard guard(AssignMutex());
  Barrier& barrier = BarrierOf(handle);
  CheckNobodyWaits(barrier.num_waiting(), "at the barrier");
  RecordIf(TraceClass::kEvents, TraceAction::kBarrierRelease,
           TraceData(barrier.number()));
  TheTables().barriers.Release(handle);
  TheTables().free_barriers.emplace(barrier.num_tasks(), &barrier);
}

}  // namespace macrotask::cray
