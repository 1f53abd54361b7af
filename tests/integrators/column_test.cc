#include "integrators/column.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/model_system.h"

namespace integrators {
namespace {

const support::ModelSystem kModel(3);

Column MakeColumn(const BlockMethod& method) {
  const SystemOf system(kModel);
  return Column(method, StateLayout(system), 7);
}

TEST(Column, AfterAShiftEveryValueIsFoundOneBlockEarlier) {
  for (const BlockMethod& method : {B1PC5(), B2PC5(), B4PC5()}) {
    Column column = MakeColumn(method);
    const int b = method.block_size, k = method.num_values;
    for (int round = 0; round < 20; ++round) {
      const int before = column.place();
      std::vector<const double*> f;
      for (int offset = 1 - k + b; offset <= b; ++offset) {
        f.push_back(column.f(before, offset).data());
      }
      const double* last = column.y(before, b).data();
      column.ShiftBlocks();
      const int after = column.place();
      for (int offset = 1 - k; offset <= 0; ++offset) {
        EXPECT_EQ(column.f(after, offset).data(),
                  f[static_cast<std::size_t>(offset + k - 1)]);
      }
      EXPECT_EQ(column.y(after, 0).data(), last);
      EXPECT_EQ(column.newest(), 7 + (round + 1) * b);
    }
  }
}

TEST(Column, NoValueThatABlockReadsIsWrittenInIt) {
  for (const BlockMethod& method :
       {B1PC5(), B2PC5(), B4PC5(), MakeBlockMethod(2, 8)}) {
    Column column = MakeColumn(method);
    for (int place = 0; place < column.num_places(); ++place) {
      std::set<const double*> slots;
      for (int offset = 1 - method.num_values; offset <= method.block_size;
           ++offset) {
        EXPECT_TRUE(slots.insert(column.f(place, offset).data()).second);
      }
    }
  }
}

TEST(Column, SlotAlwaysBelongsToTheSamePoint) {
  Column column = MakeColumn(B4PC5());
  for (int i = 1; i <= 4; ++i) {
    std::set<const double*> own;
    for (int place = 0; place < column.num_places(); ++place) {
      own.insert(column.f(place, i).data());
    }
    // As many slots as places, none shared with another point.
    EXPECT_EQ(own.size(), static_cast<std::size_t>(column.num_places()));
    for (int place = 0; place < column.num_places(); ++place) {
      EXPECT_TRUE(own.contains(column.f(place, i - 4).data()));
    }
  }
}

}  // namespace
}  // namespace integrators
