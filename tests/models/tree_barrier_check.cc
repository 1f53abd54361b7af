// The memory orders of TreeBarrier, and of Epoch as it uses them, by relacy.

#include "macrotask/epoch.cc"
#include "macrotask/tree_barrier.cc"
#include "tests/models/checked/check.h"
#include "tests/models/member_phases.h"

int main() {
  using namespace macrotask;
  return checked::Check(
      {
          &checked::Search<EveryMemberReadsWhatAllWrote<TreeBarrier, 2>>,
          &checked::Search<EveryMemberReadsWhatAllWrote<TreeBarrier, 3>>,
          &checked::Search<EveryMemberReadsWhatAllWrote<TreeBarrier, 3, 1>>,
          // Three levels.
          &checked::Search<EveryMemberReadsWhatAllWrote<TreeBarrier, 6>>,
      },
      {});
}
