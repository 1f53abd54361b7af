// Uses each installed library once; returns 0 if all did as they say.

#include <iostream>

#include "macrotask/barrier.h"
#include "macrotask/task.h"

// What task 0 writes before the barrier, task 1 reads after it.
bool BarrierOrdersTwoTasks() {
  macrotask::Barrier barrier(2);
  int written = 0;
  int read = 0;
  macrotask::RunTasks(2, [&](int task) {
    if (task == 0) written = 7;
    barrier.Sync();
    if (task == 1) read = written;
  });
  return read == 7;
}

int main() {
  if (!BarrierOrdersTwoTasks()) {
    std::cerr << "macrotask: the barrier does not order two tasks\n";
    return 1;
  }
  // dynamics and integrators: one function each, called here.
  return 0;
}
