// What the roster says that a contestant claims, before any worker runs, is what the built contestant claims.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/contestants/built_in.h"
#include "bench/contestants/contestant.h"
#include "bench/meshes/meshes.h"

namespace touchmark::bench::contestants {
namespace {

TEST(ClaimedGuarantee, IsThatOfTheBuiltContestant) {
  const TriangleMesh mesh = meshes::load_mesh("icosphere:1");
  std::vector<ContestantSpec> specs = roster().thorough_set();
  for (const ContestantSpec& spec : roster().forms(&Forms::frontier)) specs.push_back(spec);
  std::size_t compared = 0;
  for (const ContestantSpec& spec : specs) {
    ASSERT_TRUE(spec.claimed) << spec.text();
    // Another program has that build of the library; its claims do not depend on the build.
    if (roster().find(spec.name).worker_program(spec.values) != default_worker_program) continue;
    EXPECT_EQ(*spec.claimed, roster().build(spec, mesh)->accuracy().guarantee) << spec.text();
    ++compared;
  }
  EXPECT_GE(compared, 10U);
}

TEST(ClaimedGuarantee, FollowsTheOptions) {
  const auto claimed = [](const std::string& accuracy, const std::string& shape, const std::string& cell) {
    return claimed_guarantee(accuracy, OptionValues({{"shape", shape}, {"cell", cell}}));
  };
  const std::string accuracy = "approximate; shape=cube with cell=1: exact; cell=2: conservative";
  EXPECT_EQ(claimed(accuracy, "cube", "1"), Guarantee::exact);
  EXPECT_EQ(claimed(accuracy, "sphere", "1"), Guarantee::approximate);
  EXPECT_EQ(claimed(accuracy, "cube", "2"), Guarantee::conservative);
  EXPECT_EQ(claimed("", "cube", "1"), std::nullopt);
  for (const char* bad : {"precise", "exact; cube: exact", "exact; size=1: exact", "exact; cell=1 exact"})
    EXPECT_THROW(claimed(bad, "cube", "1"), std::invalid_argument) << bad;
}

}  // namespace
}  // namespace touchmark::bench::contestants
