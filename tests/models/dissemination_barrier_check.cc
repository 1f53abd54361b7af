// The memory orders of DisseminationBarrier, and of Epoch as it uses them, by
// relacy.

#include "macrotask/dissemination_barrier.cc"
#include "macrotask/epoch.cc"
#include "tests/models/checked/check.h"
#include "tests/models/member_phases.h"

int main() {
  using namespace macrotask;
  return checked::Check(
      {
          &checked::Search<
              EveryMemberReadsWhatAllWrote<DisseminationBarrier, 2>>,
          &checked::Search<
              EveryMemberReadsWhatAllWrote<DisseminationBarrier, 3>>,
          &checked::Search<
              EveryMemberReadsWhatAllWrote<DisseminationBarrier, 3, 1>>,
      },
      {});
}
