#include "dynamics/open_chain.h"

#include "dynamics/chain_terms-inl.h"
#include "dynamics/ldlt.h"

namespace dynamics {
namespace {

template <typename S>
Vector6<S> AsVector6(const SpatialVector<S>& v) {
  Vector6<S> result;
  result << v.angular, v.linear;
  return result;
}

// q''_open and H^-1 J^T from the factors of H, and J^T and tau - C - G as
// L^-1 finds them.
template <typename S>
void SolveJoints(int n, OpenChainWork<S>* work, OpenChain<S>* open) {
  const MatrixX<S>& L = work->terms.H;
  for (int i = 0; i < n; ++i) {
    SpatialVector<S> row = work->terms.J[i];
    S y = work->Linv_tau[i];
    for (int k = 0; k < i; ++k) {
      row.angular -= work->Linv_JT[k].angular * L(i, k);
      row.linear -= work->Linv_JT[k].linear * L(i, k);
      y -= work->Linv_tau[k] * L(i, k);
    }
    work->Linv_JT[i] = row;
    work->Linv_tau[i] = y;
  }
  for (int i = n - 1; i >= 0; --i) {
    const S d_inv = work->d_inv[i];
    SpatialVector<S> row = {work->Linv_JT[i].angular * d_inv,
                            work->Linv_JT[i].linear * d_inv};
    S qdd = work->Linv_tau[i] * d_inv;
    for (int k = i + 1; k < n; ++k) {
      row.angular -= open->Hinv_JT[k].angular * L(k, i);
      row.linear -= open->Hinv_JT[k].linear * L(k, i);
      qdd -= open->qdd_open[k] * L(k, i);
    }
    open->Hinv_JT[i] = row;
    open->qdd_open[i] = qdd;
  }
}

// x''_open (6) and the lower triangle of Lambda^-1 (7), both through L^-1 J^T.
template <typename S>
void CalcTip(int n, const OpenChainWork<S>& work, OpenChain<S>* open,
             Matrix6<S>* Lambda_inv) {
  open->a_open = AsVector6(work.terms.Jd_qd);
  for (int i = 0; i < n; ++i) {
    const Vector6<S> y = AsVector6(work.Linv_JT[i]);
    const Vector6<S> y_d = y * work.d_inv[i];
    open->a_open += y_d * work.Linv_tau[i];
    for (int a = 0; a < 6; ++a) {
      for (int b = 0; b <= a; ++b) {
        const S product = y[a] * y_d[b];
        (*Lambda_inv)(a, b) = i == 0 ? product : (*Lambda_inv)(a, b) + product;
      }
    }
  }
}

}  // namespace

template <typename S>
OpenChain<S>::OpenChain(int num_joints)
    : qdd_open(num_joints), Hinv_JT(num_joints) {}

template <typename S>
OpenChainWork<S>::OpenChainWork(int num_joints)
    : terms(num_joints),
      d_inv(num_joints),
      Linv_JT(num_joints),
      Linv_tau(num_joints) {}

// Flattened: left to itself GCC calls the small spatial products and passes
// packs through memory, which costs a third.
template <typename S>
[[gnu::flatten]] void CalcOpenChain(const ChainConstants<S>& chain, const S* q,
                                    const S* qd, const S* tau,
                                    OpenChainWork<S>* work,
                                    OpenChain<S>* open) {
  const int n = chain.num_joints();
  ChainTerms<S>& terms = work->terms;
  internal::CalcChainTermsInline(chain, q, qd, &terms);

  const S margin_H = FactorizeLdlt(n, &terms.H, work->d_inv.data());
  for (int i = 0; i < n; ++i) work->Linv_tau[i] = tau[i] - terms.bias[i];
  SolveJoints(n, work, open);

  Matrix6<S> Lambda_inv;
  CalcTip(n, *work, open, &Lambda_inv);
  S d_inv[6];
  const S margin_Lambda = FactorizeLdlt(6, &Lambda_inv, d_inv);
  Matrix6<S> L_inv;
  InvertLdlt(6, Lambda_inv, d_inv, &L_inv, &open->Lambda);

  for (int a = 0; a < 6; ++a) {
    S sum = open->Lambda(a, 0) * open->a_open[0];
    for (int b = 1; b < 6; ++b) sum += open->Lambda(a, b) * open->a_open[b];
    open->Lambda_a_open[a] = sum;
  }
  // Fewer than six joints cannot move the tip in all directions, whatever
  // rounding makes of the last pivots.
  open->margin = n < 6 ? S(-1.0) : Min(margin_Lambda, margin_H);
}

#define DYNAMICS_INSTANTIATE(S)                                             \
  template struct OpenChain<S>;                                             \
  template struct OpenChainWork<S>;                                         \
  template void CalcOpenChain(const ChainConstants<S>&, const S*, const S*, \
                              const S*, OpenChainWork<S>*, OpenChain<S>*);
DYNAMICS_INSTANTIATE(double)
DYNAMICS_INSTANTIATE(Pack<4>)
#undef DYNAMICS_INSTANTIATE

}  // namespace dynamics
