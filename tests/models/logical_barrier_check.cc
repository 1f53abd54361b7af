// The memory orders of LogicalBarrier, by relacy.

#include "macrotask/logical_barrier.cc"
#include "tests/models/checked/check.h"

namespace macrotask {
namespace {

// What every processor writes before its tasks arrive, every processor reads
// after they have left, in memory that is not atomic: twice in a row, so that
// the next phase's writes must not overtake this one's reads. The tasks of a
// processor arrive one after the other, and it publishes whenever it likes; the
// last of num_processors + num_pthreads are pthreads.
template <int num_processors, int tasks_per_processor, int num_pthreads>
struct EveryTaskReadsWhatAllWrote
    : rl::test_suite<EveryTaskReadsWhatAllWrote<
                         num_processors, tasks_per_processor, num_pthreads>,
                     num_processors + num_pthreads> {
  static constexpr int kNumRuns = 20000;
  static constexpr int kNumThreads = num_processors + num_pthreads;

  LogicalBarrier barrier{num_processors * tasks_per_processor + num_pthreads,
                         1};
  rl::var<int> written[kNumThreads];

  // All tasks of a processor.
  void SyncAll(LogicalProcessor& processor) {
    processor_of_caller = &processor;
    std::uint64_t ends[tasks_per_processor];
    for (std::uint64_t& end : ends) {
      barrier.Sync();
      end = processor.TakeWait();
      if (processor.must_flush() && rl::rand(2) == 0) {
        barrier.Publish(&processor);
      }
    }
    if (processor.must_flush()) barrier.Publish(&processor);
    for (const std::uint64_t end : ends) {
      while (!barrier.IsPast(end, processor.slot())) rl::yield(1, RL_INFO);
    }
  }

  void thread(unsigned thread) {
    const bool is_pthread = thread >= num_processors;
    LogicalProcessor processor(static_cast<int>(thread));
    processor_of_caller = nullptr;
    for (int phase = 0; phase < 2; ++phase) {
      written[thread](RL_INFO) = phase;
      is_pthread ? barrier.Sync() : SyncAll(processor);
      for (auto& other : written) RL_ASSERT(other(RL_INFO) == phase);
      is_pthread ? barrier.Sync() : SyncAll(processor);
    }
  }
};

}  // namespace
}  // namespace macrotask

int main() {
  using namespace macrotask;
  return checked::Check(
      {
          &checked::Search<EveryTaskReadsWhatAllWrote<2, 1, 0>>,
          &checked::Search<EveryTaskReadsWhatAllWrote<2, 2, 0>>,
          &checked::Search<EveryTaskReadsWhatAllWrote<3, 1, 0>>,
          &checked::Search<EveryTaskReadsWhatAllWrote<1, 2, 1>>,
          &checked::Search<EveryTaskReadsWhatAllWrote<1, 1, 2>>,
      },
      // Who misses a slot misses arrivals and looks again. A task has left the
      // phase before by what it has read of every line, and each of these was
      // written after its slot: it sees all slots of that phase by the lines.
      {"NumArrivals() load acquire -> relaxed (1)",
       "TakePart() change release -> relaxed"});
}
