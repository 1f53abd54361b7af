#include "dynamics/ldlt.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <limits>

#include "tests/dynamics/support.h"

namespace dynamics {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Random symmetric positive definite matrix with eigenvalues 1 ... 100.
Eigen::MatrixXd RandomSpd(int n, support::Random* random) {
  Eigen::MatrixXd A(n, n);
  for (int j = 0; j < n; ++j) A.col(j) = random->Vector(n, 1.0);
  const Eigen::MatrixXd Q = A.householderQr().householderQ();
  Eigen::VectorXd eigenvalues(n);
  for (double& x : eigenvalues) x = random->Uniform(1, 100);
  return Q * eigenvalues.asDiagonal() * Q.transpose();
}

// A matrix and a right-hand side in every lane. The upper triangle is NaN,
// since it must not be read.
template <typename S>
struct Problem {
  Problem(int size, support::Random* random)
      : n(size), lower(n, n), rhs(n), d_inv(n) {
    for (int lane = 0; lane < kLanesOf<S>; ++lane) {
      A.push_back(RandomSpd(n, random));
      b.push_back(random->Vector(n, 1.0));
      SetMatrix(lane, A[lane]);
    }
    rhs = Interleave<S>(b);
  }
  void SetMatrix(int lane, const Eigen::MatrixXd& value) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        SetLane(&lower(i, j), lane, j <= i ? value(i, j) : kNan);
      }
    }
  }
  S Factorize() { return FactorizeLdlt(n, &lower, d_inv.data()); }
  VectorX<S> Solve() {
    VectorX<S> x = rhs;
    SolveLdlt(n, lower, d_inv.data(), &x);
    return x;
  }

  int n;
  std::vector<Eigen::MatrixXd> A;
  std::vector<Eigen::VectorXd> b;
  MatrixX<S> lower;
  VectorX<S> rhs;
  VectorX<S> d_inv;
};

template <typename S>
class LdltTest : public testing::Test {};
TYPED_TEST_SUITE(LdltTest, Scalars);

TYPED_TEST(LdltTest, FactorsMultiplyToTheMatrix) {
  support::Random random(1);
  for (int n = 1; n <= 9; ++n) {
    Problem<TypeParam> problem(n, &random);
    const TypeParam margin = problem.Factorize();
    for (int lane = 0; lane < kLanesOf<TypeParam>; ++lane) {
      EXPECT_GT(Lane(margin, lane), 0);
      const Eigen::MatrixXd factors = LaneOf(problem.lower, lane);
      const Eigen::MatrixXd L =
          factors.triangularView<Eigen::UnitLower>().toDenseMatrix();
      const Eigen::VectorXd D = LaneOf(problem.d_inv, lane).cwiseInverse();
      EXPECT_TRUE(IsClose(L * D.asDiagonal() * L.transpose(), problem.A[lane],
                          kDirect));
    }
  }
}

TYPED_TEST(LdltTest, SolutionSatisfiesTheEquation) {
  support::Random random(2);
  for (int n = 1; n <= 9; ++n) {
    Problem<TypeParam> problem(n, &random);
    problem.Factorize();
    const VectorX<TypeParam> x = problem.Solve();
    for (int lane = 0; lane < kLanesOf<TypeParam>; ++lane) {
      EXPECT_TRUE(
          IsClose(problem.A[lane] * LaneOf(x, lane), problem.b[lane], kDirect));
    }
  }
}

TYPED_TEST(LdltTest, InverseIsSymmetricAndFillsBothTriangles) {
  support::Random random(3);
  for (int n = 1; n <= 9; ++n) {
    Problem<TypeParam> problem(n, &random);
    problem.Factorize();
    MatrixX<TypeParam> L_inv(n, n), A_inv(n, n);
    InvertLdlt(n, problem.lower, problem.d_inv.data(), &L_inv, &A_inv);
    for (int lane = 0; lane < kLanesOf<TypeParam>; ++lane) {
      const Eigen::MatrixXd inverse = LaneOf(A_inv, lane);
      EXPECT_TRUE(HasSameBits(inverse, inverse.transpose()));
      EXPECT_TRUE(IsClose(problem.A[lane] * inverse,
                          Eigen::MatrixXd::Identity(n, n), kDirect));
    }
  }
}

// A lane with a bad matrix is reported; the others hold what they hold without
// it.
template <typename S>
void ExpectReportedInItsLaneOnly(const Eigen::MatrixXd& bad) {
  const int n = static_cast<int>(bad.rows());
  support::Random random(4);
  Problem<S> sound(n, &random);
  for (int bad_lane = 0; bad_lane < kLanesOf<S>; ++bad_lane) {
    Problem<S> problem = sound;
    problem.SetMatrix(bad_lane, bad);
    const S margin = problem.Factorize();
    const VectorX<S> x = problem.Solve();
    Problem<S> reference = sound;
    const S reference_margin = reference.Factorize();
    const VectorX<S> reference_x = reference.Solve();
    for (int lane = 0; lane < kLanesOf<S>; ++lane) {
      if (lane == bad_lane) {
        EXPECT_FALSE(Lane(margin, lane) > 0) << bad;
      } else {
        EXPECT_TRUE(SameBits(Lane(margin, lane), Lane(reference_margin, lane)));
        EXPECT_TRUE(HasSameBits(LaneOf(x, lane), LaneOf(reference_x, lane)));
      }
    }
  }
}

TYPED_TEST(LdltTest, MarginOfASingularMatrixIsNotPositive) {
  support::Random random(5);
  for (int n = 1; n <= 9; ++n) {
    for (int rank = 0; rank < n; ++rank) {
      Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
      for (int i = 0; i < rank; ++i) {
        const Eigen::VectorXd v = random.Vector(n, 1.0);
        A += v * v.transpose();
      }
      ExpectReportedInItsLaneOnly<TypeParam>(A);
    }
  }
}

TYPED_TEST(LdltTest, MarginOfAnIndefiniteMatrixIsNotPositive) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(6, 6);
  for (int i = 0; i < 6; ++i) {
    A(i, i) = -1;
    ExpectReportedInItsLaneOnly<TypeParam>(A);
    A(i, i) = 1;
  }
  A(4, 1) = A(1, 4) = 2;  // positive diagonal
  ExpectReportedInItsLaneOnly<TypeParam>(A);
}

TYPED_TEST(LdltTest, MarginIsNotPositiveWhereverANanIs) {
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) {
      Eigen::MatrixXd A = Eigen::MatrixXd::Identity(6, 6);
      A(i, j) = kNan;
      ExpectReportedInItsLaneOnly<TypeParam>(A);
    }
  }
}

TYPED_TEST(LdltTest, MarginTurnsWhereThePivotIsASmallPartOfItsDiagonal) {
  for (const double part : {10.0, 0.1}) {
    Eigen::MatrixXd A(2, 2);
    A << 1, 1, 1, 1 + part * kSingularPivot;
    support::Random random(6);
    Problem<TypeParam> problem(2, &random);
    problem.SetMatrix(0, A);
    EXPECT_EQ(Lane(problem.Factorize(), 0) > 0, part > 1);
  }
}

}  // namespace
}  // namespace dynamics
