#include "dynamics/closed_chain.h"

namespace dynamics {

template <typename S>
[[gnu::flatten]] void CalcClosedChain(const OpenChain<S>& open,
                                      const Vector6<S>& a_r, Vector6<S>* f,
                                      S* qdd) {
  for (int a = 0; a < 6; ++a) {
    S sum = open.Lambda_a_open[a];
    for (int b = 0; b < 6; ++b) sum -= open.Lambda(a, b) * a_r[b];
    (*f)[a] = sum;
  }
  const SpatialVector<S> wrench = {f->template head<3>(),
                                   f->template tail<3>()};
  const int n = static_cast<int>(open.qdd_open.size());
  for (int i = 0; i < n; ++i) {
    qdd[i] = open.qdd_open[i] - open.Hinv_JT[i].Dot(wrench);
  }
}

template void CalcClosedChain(const OpenChain<double>&, const Vector6<double>&,
                              Vector6<double>*, double*);
template void CalcClosedChain(const OpenChain<Pack<4>>&,
                              const Vector6<Pack<4>>&, Vector6<Pack<4>>*,
                              Pack<4>*);

}  // namespace dynamics
