#pragma once

#include <array>

// Figures of [MSO93], CRAY Y-MP8/864: what the reproduction is held against.

namespace bench {

struct PaperRow {
  int processors;
  int chain_tasks;        // m^
  int integration_tasks;  // p^
  int block_size;
  double T;  // s
  double S_p, S_a, S_T;
};

// Table 2, in its order. Table 1 is its rows of block size 4.
inline constexpr std::array<PaperRow, 12> kPaperTable2 = {{
    {1, 1, 1, 4, 0.241, 1.00, 0.485, 0.485},
    {1, 1, 1, 2, 0.152, 1.00, 0.770, 0.770},
    {1, 1, 1, 1, 0.117, 1.00, 1.00, 1.00},
    {4, 1, 4, 4, 0.0637, 3.78, 0.485, 1.83},
    {4, 2, 2, 4, 0.0668, 3.61, 0.485, 1.75},
    {4, 2, 2, 2, 0.0444, 3.42, 0.770, 2.63},
    {4, 4, 1, 4, 0.0731, 3.30, 0.485, 1.60},
    {4, 4, 1, 2, 0.0463, 3.28, 0.770, 2.53},
    {4, 4, 1, 1, 0.0377, 3.10, 1.00, 3.10},
    {8, 2, 4, 4, 0.0390, 6.18, 0.485, 3.00},
    {8, 4, 2, 4, 0.0417, 5.78, 0.485, 2.80},
    {8, 4, 2, 2, 0.0295, 5.15, 0.770, 3.97},
}};

}  // namespace bench
