#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <vector>

#include "macrotask/cray.h"
#include "macrotask/task_list.h"
#include "tests/macrotask/support.h"

namespace macrotask {

using Routine = void (*)();

// A routine of any arguments, as TSKSTART takes it.
template <typename Function>
Routine AsRoutine(Function* function) {
  return reinterpret_cast<Routine>(function);
}

extern "C" inline void CrayTaskBody(const std::function<void(int)>* body,
                                    long task) {
  (*body)(static_cast<int>(task));
}

// Tasks started by TSKSTART, with handles of the type Word, which run
// body(0), body(1), ...
template <typename Word>
class CrayTasks {
 public:
  CrayTasks(int num_tasks, std::function<void(int)> body)
      : body_(std::move(body)), tcas_(static_cast<std::size_t>(num_tasks)) {
    long task = 0;
    for (auto& tca : tcas_) {
      tca = {2, -1};
      TSKSTART(tca.data(), AsRoutine(&CrayTaskBody), &body_, task++);
    }
  }
  ~CrayTasks() {
    for (auto& tca : tcas_) TSKWAIT(tca.data());
  }
  CrayTasks(const CrayTasks&) = delete;
  CrayTasks& operator=(const CrayTasks&) = delete;

 private:
  const std::function<void(int)> body_;
  std::deque<std::vector<Word>> tcas_;
};

template <typename Word>
void RunCrayTasks(int num_tasks, const std::function<void(int)>& body) {
  const CrayTasks<Word> tasks(num_tasks, body);
}

inline int NumWaitingTasks() {
  int number = 0;
  for (const TaskStatus& task : ListTasks()) {
    number += task.state == TaskState::kWaiting;
  }
  return number;
}

}  // namespace macrotask
