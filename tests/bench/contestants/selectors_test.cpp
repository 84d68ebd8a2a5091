#include "bench/contestants/selectors.h"

#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "bench/contestants/roster.h"

namespace touchmark::bench::contestants {
namespace {

std::string error_of(const Selectors& selectors) {
  try {
    check(selectors, Roster({}));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Length, IsInMeshUnitsOrInPercentOfTheBoxDiagonal) {
  const TriangleMesh mesh({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}});
  EXPECT_EQ(support::parse_length("0.5%")->in_mesh_units(mesh), 0.5 / 100 * 5);
  EXPECT_EQ(support::parse_length("0.5")->in_mesh_units(mesh), 0.5);
  EXPECT_EQ(support::parse_length("0")->in_mesh_units(mesh), 0);
  EXPECT_EQ(support::parse_length("inf")->in_mesh_units(mesh), std::numeric_limits<double>::infinity());
}

TEST(Length, RefusesWhatIsNoLength) {
  for (const char* bad : {"", "%", "-1", "nan", "1 %", "1mm", "5%%", "1e999"}) {
    EXPECT_FALSE(support::parse_length(bad)) << bad;
  }
}

TEST(Selectors, ReachIsTheRadiusUnlessGiven) {
  Selectors selectors;
  EXPECT_FALSE(check(selectors, Roster({})).reach);
  selectors.reach = "inf";
  EXPECT_EQ(check(selectors, Roster({})).reach->value, std::numeric_limits<double>::infinity());
}

TEST(Selectors, NameTheOptionAndTheValueThatIsWrong) {
  Selectors selectors;
  selectors.query = "near";
  EXPECT_EQ(error_of(selectors), "--query \"near\" is not one of touches, nearest, sweep, moving");
  selectors = {};
  selectors.radius = "-1";
  EXPECT_EQ(
      error_of(selectors),
      "--radius \"-1\" is not a length: 0 or more in mesh units, or in percent of the box diagonal, as 0.5%");
  for (const char* steps : {"0", "-1", "1.5", "1e3", "x", "100000001", "99999999999999999999"}) {
    selectors = {};
    selectors.steps = steps;
    EXPECT_EQ(error_of(selectors),
              "--steps \"" + std::string(steps) + "\" is not a whole number from 1 to 100000000");
  }
  selectors = {};
  selectors.seed = "-3";
  EXPECT_EQ(error_of(selectors), "--seed \"-3\" is not a whole number from 0 to 18446744073709551615");
}

}  // namespace
}  // namespace touchmark::bench::contestants
