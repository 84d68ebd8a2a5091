// What every filter in single precision stands on: that the compiler rounds where the source says so.
#include <limits>

#include <gtest/gtest.h>

#include "core/probe.h"

namespace touchmark {
namespace {

[[gnu::noinline]] void round_through_single(Vec3& p) { p = p.cast<float>().cast<double>(); }

[[gnu::noinline]] void round_one_by_one(Vec3& p) {
  for (int k = 0; k < 3; ++k) {
    const auto rounded = static_cast<float>(p[k]);
    p[k] = rounded;
  }
}

const double just_above_one = 1 + std::numeric_limits<double>::epsilon();

TEST(Rounding, AVectorThroughSinglePrecisionLosesWhatDoesNotFit) {
  Vec3 p(just_above_one, just_above_one, just_above_one);
  round_through_single(p);
  EXPECT_EQ(p, Vec3::Ones());
}

TEST(Rounding, CoordinatesThroughSinglePrecisionLoseWhatDoesNotFit) {
  Vec3 p(just_above_one, just_above_one, just_above_one);
  round_one_by_one(p);
  EXPECT_EQ(p, Vec3::Ones());
}

TEST(Rounding, ProductsAreRoundedBeforeTheyAreAdded) {
  volatile double a = just_above_one, b = -just_above_one * just_above_one;
  EXPECT_EQ(a * a + b, 0);
}

TEST(Rounding, SoTheyAreInProductsOfEigensMatrices) {
  const volatile double a = just_above_one, b = -just_above_one * just_above_one;
  const Eigen::Matrix2d left = Eigen::Matrix2d{{b, a}, {b, a}}, right = Eigen::Matrix2d{{1, 1}, {a, a}};
  EXPECT_EQ(Eigen::Matrix2d(left * right), Eigen::Matrix2d::Zero());
}

}  // namespace
}  // namespace touchmark
