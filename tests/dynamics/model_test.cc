#include "dynamics/model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "tests/dynamics/support.h"

namespace dynamics {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// What CheckModel says about two sound chains after `spoil`.
std::string Complaint(const std::function<void(SystemModel*)>& spoil) {
  support::Random random(1);
  SystemModel model;
  for (int k = 0; k < 2; ++k) {
    model.chains.push_back(support::RandomChain(6, 1, &random));
  }
  model.member = {.mass = 2, .inertia = random.Inertia()};
  spoil(&model);
  return MessageOf<std::invalid_argument>([&] { CheckModel(model); });
}

TEST(CheckModel, AcceptsASoundModel) {
  EXPECT_EQ(Complaint([](SystemModel*) {}), "");
}

TEST(CheckModel, AcceptsMasslessLinks) {
  EXPECT_EQ(Complaint([](SystemModel* model) {
              model->chains[0].arm.links[0].mass = 0;
              model->chains[0].arm.links[0].inertia.setZero();
            }),
            "");
}

TEST(CheckModel, AsksForAtLeastOneChain) {
  EXPECT_EQ(Complaint([](SystemModel* model) { model->chains.clear(); }),
            "the system: expected at least one chain");
}

TEST(CheckModel, NamesTheChainWithoutJoints) {
  EXPECT_EQ(
      Complaint([](SystemModel* model) { model->chains[1].arm.links.clear(); }),
      "chain 1: expected at least one joint");
}

TEST(CheckModel, NamesTheLinkWhoseMassIsBad) {
  for (const double mass : {-1.0, kNan, kInfinity}) {
    EXPECT_EQ(Complaint([mass](SystemModel* model) {
                model->chains[1].arm.links[2].mass = mass;
              }),
              "chain 1, link 3: the mass must be a finite number of kg, not "
              "below zero");
  }
}

TEST(CheckModel, NamesTheLinkWhoseInertiaIsBad) {
  for (const double element : {5.0, kNan, kInfinity}) {
    EXPECT_EQ(Complaint([element](SystemModel* model) {
                model->chains[0].arm.links[5].inertia(0, 1) = element;
              }),
              "chain 0, link 6: the inertia must be a finite, symmetric "
              "matrix, not below zero");
  }
  EXPECT_EQ(Complaint([](SystemModel* model) {
              model->chains[0].arm.links[5].inertia =
                  -Eigen::Matrix3d::Identity();
            }),
            "chain 0, link 6: the inertia must be a finite, symmetric matrix, "
            "not below zero");
}

TEST(CheckModel, NamesTheLinkOrChainWhoseOtherFiguresAreBad) {
  EXPECT_EQ(Complaint([](SystemModel* model) {
              model->chains[1].arm.links[0].com.x() = kNan;
            }),
            "chain 1, link 1: the centre of mass and the joint frame must be "
            "finite");
  EXPECT_EQ(Complaint([](SystemModel* model) {
              model->chains[1].arm.links[0].rotor_inertia = -1;
            }),
            "chain 1, link 1: the rotor inertia must be finite, not below "
            "zero");
  EXPECT_EQ(Complaint([](SystemModel* model) {
              model->chains[1].base.translation().y() = kInfinity;
            }),
            "chain 1: the poses of base, tip and grip must be finite");
}

TEST(CheckModel, AsksForAReferenceMemberWithMassAndInertia) {
  const std::string expected =
      "the reference member: mass and inertia must be positive";
  EXPECT_EQ(Complaint([](SystemModel* model) { model->member.mass = 0; }),
            expected);
  EXPECT_EQ(
      Complaint([](SystemModel* model) { model->member.inertia.setZero(); }),
      expected);
  EXPECT_EQ(Complaint([](SystemModel* model) {
              model->member.inertia = Eigen::Vector3d(1, 1, -1).asDiagonal();
            }),
            "the reference member: the inertia must be a finite, symmetric "
            "matrix, not below zero");
  EXPECT_TRUE(
      Contains(Complaint([](SystemModel* model) { model->member.mass = kNan; }),
               "the reference member: the mass"));
}

// A textbook's matrix from one link frame to the next.
Eigen::Matrix4d DhMatrix(double theta, double d, double a, double alpha) {
  const double ct = std::cos(theta), st = std::sin(theta);
  const double ca = std::cos(alpha), sa = std::sin(alpha);
  Eigen::Matrix4d A;
  A << ct, -st * ca, st * sa, a * ct,  //
      st, ct * ca, -ct * sa, a * st,   //
      0, sa, ca, d,                    //
      0, 0, 0, 1;
  return A;
}

std::vector<DhRow> RandomRows(int n, support::Random* random) {
  std::vector<DhRow> rows;
  for (int i = 0; i < n; ++i) {
    rows.push_back(
        {.type = i % 3 == 1 ? JointType::kPrismatic : JointType::kRevolute,
         .alpha = random->Uniform(-2, 2),
         .a = random->Uniform(-1, 1),
         .d = random->Uniform(-1, 1),
         .theta = random->Uniform(-2, 2),
         .mass = random->Uniform(1, 2),
         .com = random->Vector(3, 0.5),
         .principal_inertia = {0.1, 0.2, 0.25},
         .rotor_inertia = 0.5 * i});
  }
  return rows;
}

// Through the oracle, whose member is put where the frame in question is.
TEST(ArmFromDh, TipIsTheProductOfTheDhMatrices) {
  support::Random random(2);
  for (int n = 1; n <= 7; ++n) {
    const std::vector<DhRow> rows = RandomRows(n, &random);
    const Eigen::VectorXd q = random.Vector(n, 2.0);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
    Eigen::Matrix4d expected = Eigen::Matrix4d::Identity();
    for (int i = 0; i < n; ++i) {
      const DhRow& row = rows[i];
      const bool turns = row.type == JointType::kRevolute;
      expected *= DhMatrix(row.theta + (turns ? q[i] : 0),
                           row.d + (turns ? 0 : q[i]), row.a, row.alpha);
    }
    const Chain chain = {.arm = ArmFromDh("arm", rows)};
    const auto tip = support::CalcCarriedMember(chain, q, zero, zero);
    const Eigen::Matrix3d R = expected.topLeftCorner<3, 3>();
    const Eigen::Vector3d p = expected.topRightCorner<3, 1>();
    EXPECT_TRUE(IsClose(tip.R, R, kDirect));
    EXPECT_TRUE(IsClose(tip.P, p, kDirect));
  }
}

TEST(ArmFromDh, InertialFiguresMoveFromTheLinkFrameToTheJointFrame) {
  support::Random random(3);
  const std::vector<DhRow> rows = RandomRows(5, &random);
  const ArmModel arm = ArmFromDh("arm", rows);
  EXPECT_EQ(arm.name, "arm");
  for (int i = 0; i < 5; ++i) {
    const DhRow& row = rows[i];
    const Eigen::Matrix4d A = DhMatrix(row.theta, row.d, row.a, row.alpha);
    const Eigen::Matrix3d R = A.topLeftCorner<3, 3>();
    const Eigen::Vector3d p = A.topRightCorner<3, 1>();
    EXPECT_EQ(arm.links[i].mass, row.mass);
    EXPECT_EQ(arm.links[i].rotor_inertia, row.rotor_inertia);
    EXPECT_TRUE(IsClose(arm.links[i].com, p + R * row.com, kDirect));
    EXPECT_TRUE(IsClose(arm.links[i].inertia,
                        R * row.principal_inertia.asDiagonal() * R.transpose(),
                        kDirect));
  }
}

}  // namespace
}  // namespace dynamics
