#pragma once

#include "dynamics/pack.h"

// Cholesky factorization without square roots, A = L D L^T, for symmetric
// positive definite matrices of doubles or packs. Our own and not Eigen's
// because a pack cannot branch on a pivot: a matrix that is not positive
// definite is reported, lane by lane, in what FactorizeLdlt returns.
// Matrices are anything with A(i, j); only lower triangles are read.

namespace dynamics {

// A pivot below this part of its diagonal element means that the matrix is
// singular for our purposes. Along the lift of the PUMAs the smallest ratio is
// 8e-4; 1e-5 rad from a stretched wrist (q5 = 0) it is 1e-7; there it is
// rounding error, below 3e-10 in 99 of 100 random postures.
inline constexpr double kSingularPivot = 1e-8;
// The same for J itself, whose square is in Lambda^-1.
inline constexpr double kSingularJacobian = 1e-4;

// Overwrites the strict lower triangle of the n x n matrix A with that of L and
// fills d_inv[0..n) with the reciprocals of D. Returns, lane by lane, a number
// that is positive iff every pivot is above kSingularPivot of its diagonal
// element (NaN when A has NaN).
template <typename S, typename Matrix>
S FactorizeLdlt(int n, Matrix* A_inout, S* d_inv) {
  Matrix& A = *A_inout;
  S margin = S(1.0);
  for (int j = 0; j < n; ++j) {
    S d = A(j, j);
    const S a = d;
    // Until its row is reached, A(i, k) holds (L D)(i, k).
    for (int k = 0; k < j; ++k) {
      const S LD_jk = A(j, k);
      A(j, k) = LD_jk * d_inv[k];
      d -= LD_jk * A(j, k);
    }
    margin = Min(d - a * S(kSingularPivot), margin);
    d_inv[j] = S(1.0) / d;
    for (int i = j + 1; i < n; ++i) {
      S LD_ij = A(i, j);
      for (int k = 0; k < j; ++k) LD_ij -= A(i, k) * A(j, k);
      A(i, j) = LD_ij;
    }
  }
  return margin;
}

// x <- L^-1 x, for a vector of anything that has `x[i] -= x[k] * S`.
template <typename Matrix, typename Vector>
void SolveLower(int n, const Matrix& L, Vector* x) {
  for (int i = 1; i < n; ++i) {
    for (int k = 0; k < i; ++k) (*x)[i] -= (*x)[k] * L(i, k);
  }
}

// x <- L^-T x.
template <typename Matrix, typename Vector>
void SolveLowerTransposed(int n, const Matrix& L, Vector* x) {
  for (int i = n - 2; i >= 0; --i) {
    for (int k = i + 1; k < n; ++k) (*x)[i] -= (*x)[k] * L(k, i);
  }
}

// x <- A^-1 x, from the factors.
template <typename S, typename Matrix, typename Vector>
void SolveLdlt(int n, const Matrix& L, const S* d_inv, Vector* x) {
  SolveLower(n, L, x);
  for (int i = 0; i < n; ++i) (*x)[i] *= d_inv[i];
  SolveLowerTransposed(n, L, x);
}

// Fills both triangles of `A_inv` with A^-1 = L^-T D^-1 L^-1; `L_inv` is work
// space of the same shape.
template <typename S, typename Matrix>
void InvertLdlt(int n, const Matrix& L, const S* d_inv, Matrix* L_inv,
                Matrix* A_inv) {
  Matrix& X = *L_inv;
  for (int j = 0; j < n; ++j) {
    for (int i = j + 1; i < n; ++i) {
      S x = -L(i, j);
      for (int k = j + 1; k < i; ++k) x -= L(i, k) * X(k, j);
      X(i, j) = x;
    }
  }
  for (int b = 0; b < n; ++b) {
    for (int a = b; a < n; ++a) {
      S sum = a == b ? d_inv[a] : d_inv[a] * X(a, b);
      for (int k = a + 1; k < n; ++k) sum += X(k, a) * (d_inv[k] * X(k, b));
      (*A_inv)(a, b) = sum;
      (*A_inv)(b, a) = sum;
    }
  }
}

}  // namespace dynamics
