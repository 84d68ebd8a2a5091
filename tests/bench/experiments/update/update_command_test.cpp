/// `touchmark update` from the outside, and what it moves.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/meshes/deformation.h"
#include "bench/meshes/meshes.h"
#include "tests/bench/cli/csv_fields.h"
#include "tests/bench/cli/run_touchmark.h"
#include "tests/temporary_folder.h"

namespace touchmark::bench::cli {
namespace {

class Update : public testing::Test {
 protected:
  Outcome update(const Fields& more) const {
    Fields command{"update", "--mesh", "icosphere:3", "--steps", "50", "--out", folder_.file("out")};
    command.insert(command.end(), more.begin(), more.end());
    return run_touchmark(command);
  }
  std::vector<Fields> read(const Fields& columns) const {
    return fields_in(folder_.file("out/update.csv"), columns);
  }
  TemporaryFolder folder_;
};

TEST_F(Update, JudgesTheAnswersAfterwardsAndLeavesWhatIsValid) {
  const Outcome outcome =
      update({"--detector", "aabb-tree", "--detector", "sphere-cluster", "--shares", "5%,100%"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  // An icosphere of three subdivisions has 642 vertices.
  EXPECT_EQ(
      read({"detector", "share", "vertices", "moved_vertices", "status", "answers_as_built", "judged",
            "missed", "false_contacts", "wrong_triangle", "beyond_bound"}),
      (std::vector<Fields>{{"aabb-tree", "0.05", "642", "32", "ok", "1", "1050", "0", "0", "0", "0"},
                           {"aabb-tree", "1", "642", "642", "ok", "1", "1050", "0", "0", "0", "0"},
                           {"sphere-cluster", "0.05", "642", "32", "ok", "1", "1050", "0", "0", "0", "0"},
                           {"sphere-cluster", "1", "642", "642", "ok", "1", "1050", "0", "0", "0", "0"}}));
  for (const Fields& row : read({"build_ms", "update_ms", "update_over_build", "ns_per_query_updated"}))
    for (const std::string& value : row) EXPECT_GT(std::stod(value), 0);
  EXPECT_EQ(run_touchmark({"validate", folder_.file("out")}).status, 0);
}

TEST_F(Update, SaysWhoCannot) {
  EXPECT_EQ(update({"--detector", "libccd+aabb", "--shares", "10%"}).status, 0);
  EXPECT_EQ(read({"detector", "status", "update_ms", "missed"}),
            (std::vector<Fields>{{"libccd+aabb", "unsupported", "", ""}}));
}

TEST_F(Update, RefusesSharesThatAreNone) {
  for (const char* shares : {"0", "101%", "", "1%,", "some"}) {
    const Outcome outcome = update({"--detector", "aabb-tree", "--shares", shares});
    EXPECT_EQ(outcome.status, 2) << shares;
    EXPECT_NE(outcome.err.find("--shares"), std::string::npos) << outcome.err;
  }
}

TEST(Deformation, MovesItsShareOfTheVerticesNotFar) {
  const TriangleMesh mesh = meshes::load_mesh("icosphere:4");
  const auto vertices = static_cast<double>(mesh.vertices().size());
  for (const double share : {0.01, 0.1, 1.0}) {
    const TriangleMesh after = meshes::deformed(mesh, {share, 3});
    EXPECT_NEAR(static_cast<double>(meshes::moved_vertices(mesh, after)), share * vertices, 0.5);
    double farthest = 0;
    Aabb patch;
    for (std::size_t i = 0; i < mesh.vertices().size(); ++i) {
      const double way = (after.vertices()[i] - mesh.vertices()[i]).norm();
      farthest = std::max(farthest, way);
      if (way > 0) patch.extend(mesh.vertices()[i]);
    }
    EXPECT_GT(farthest, 1e-3);
    // A quarter of its patch's radius at most; the wave 1 % of the diagonal.
    EXPECT_LE(farthest, share < 1 ? 0.25 * 0.5 * patch.diagonal() : 0.0100001 * mesh.diagonal());
    EXPECT_EQ(meshes::moved_vertices(meshes::deformed(mesh, {share, 3}), after), 0U);
    EXPECT_GT(meshes::moved_vertices(meshes::deformed(mesh, {share, 4}), after), 0U);
  }
}

}  // namespace
}  // namespace touchmark::bench::cli
