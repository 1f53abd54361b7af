// The barrier of an OpenMP runtime. Compiled once by each compiler that brings
// one, to a module of its own: bench/sync_openmp.h opens it.

#include <omp.h>

// Runs body(0, context) .. body(num_tasks - 1, context) in one parallel region.
// Returns 0, having run nothing, if the runtime gives fewer threads.
int macrotask_omp_run(int num_tasks, void (*body)(int task, void* context),
                      void* context);
int macrotask_omp_run(int num_tasks, void (*body)(int task, void* context),
                      void* context) {
  int complete = 1;
  omp_set_dynamic(0);
#pragma omp parallel num_threads(num_tasks)
  {
    if (omp_get_num_threads() == num_tasks) {
      body(omp_get_thread_num(), context);
    } else {
#pragma omp single
      complete = 0;
    }
  }
  // The runtime's idle threads spin, for up to 200 ms, and would be in the way
  // of whatever is measured next.
  omp_pause_resource_all(omp_pause_soft);
  return complete;
}

// For a body that macrotask_omp_run() runs.
void macrotask_omp_barrier(void);
void macrotask_omp_barrier(void) {
#pragma omp barrier
}
