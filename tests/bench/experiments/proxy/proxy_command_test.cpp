/// `touchmark proxy` as a user runs it.
#include <array>
#include <cstddef>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/experiments/proxy/proxy_csv.h"
#include "core/probe.h"
#include "tests/bench/cli/csv_table.h"
#include "tests/bench/cli/run_touchmark.h"
#include "tests/temporary_folder.h"

namespace touchmark::bench::cli {
namespace {

std::size_t proxy_column(const std::string& column) {
  return index_of(column, results::names_of(experiments::proxy::proxy_columns()));
}

TEST(ProxyCommand, CountsCrossingsAndItsFilesAreValid) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run_touchmark({"proxy", "--method", "penalty", "--method", "virtual-proxy", "--family", "stabs",
                     "--ticks", "400", "--seed", "3", "--out", folder.file("out")});
  EXPECT_EQ(outcome.status, 0) << "neither claims never to cross\n" << outcome.out << outcome.err;
  const auto rows = table_in(folder.file("out/proxy.csv"));
  ASSERT_EQ(rows.size(), 5U) << "two methods, balls and points apart";
  EXPECT_EQ(rows[0], results::names_of(experiments::proxy::proxy_columns()));
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i][proxy_column("method")], i <= 2 ? "penalty" : "virtual-proxy");
    EXPECT_EQ(rows[i][proxy_column("ticks")], "200");
    if (i > 2) continue;
    EXPECT_GT(std::stoi(rows[i][proxy_column("crossings")]), 0);
  }
  EXPECT_NE(content_of(folder.file("out/stab.csv")).find("surface,0"), std::string::npos);
  const Outcome valid = run_touchmark({"validate", folder.file("out")});
  EXPECT_EQ(valid.status, 0) << valid.out << valid.err;
  EXPECT_NE(valid.out.find("proxy, 4 rows"), std::string::npos) << valid.out;
}

TEST(ProxyCommand, TellsTheBareQueryOfTheDetectorBesideTheTick) {
  const TemporaryFolder folder;
  const Outcome outcome = run_touchmark({"proxy", "--method", "certified", "--method", "penalty", "--family",
                                         "rooms", "--ticks", "400", "--out", folder.file("out")});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const auto rows = table_in(folder.file("out/proxy.csv"));
  ASSERT_EQ(rows.size(), 5U);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const std::string &median = rows[i][proxy_column("query_p50_ns")],
                      &late = rows[i][proxy_column("query_p999_ns")];
    if (rows[i][proxy_column("method")] == "penalty") {
      EXPECT_EQ(median + late, "") << "it has no detector";
    } else {
      EXPECT_GT(std::atoi(median.c_str()), 0);
      EXPECT_GE(std::atoi(late.c_str()), std::atoi(median.c_str()));
    }
  }
  EXPECT_EQ(run_touchmark({"validate", folder.file("out")}).status, 0);
}

TEST(ProxyCommand, CountsTheSameAgain) {
  const auto counted = [](const std::string& path) {
    auto rows = table_in(path);
    for (auto& row : rows) {
      row.resize(proxy_column("p50_ns"));
      row.erase(row.begin() + 1);  // the run's id
    }
    return rows;
  };
  const TemporaryFolder folder;
  for (const char* name : {"one", "two"})
    EXPECT_EQ(run_touchmark({"proxy", "--method", "finger-proxy", "--family", "cracks", "--ticks", "500",
                             "--out", folder.file(name)})
                  .status,
              0);
  EXPECT_EQ(counted(folder.file("one/proxy.csv")), counted(folder.file("two/proxy.csv")));
}

/// The trace of a ball of a quarter over a cube about the origin, its side 1, after the folder's motion.csv.
auto traced_over_a_cube(const TemporaryFolder& folder, const std::string& method) {
  const Outcome outcome =
      run_touchmark({"proxy", "--method", method, "--mesh", "cube", "--trajectory", folder.file("motion.csv"),
                     "--radius", "0.25", "--trace", folder.file("trace.csv")});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  return table_in(folder.file("trace.csv"));
}

TEST(ProxyCommand, TracesEveryPieceOfEveryStep) {
  const TemporaryFolder folder;
  folder.file("motion.csv", "x,y,z\n0,0,2\n0.125,0,0.1\n0.125,0,0.1\n0,0,2\n");
  const auto rows = traced_over_a_cube(folder, "virtual-proxy");
  ASSERT_GE(rows.size(), 5U);
  const std::vector<std::string> header{"step",    "segment", "goal_x",  "goal_y",   "goal_z",
                                        "proxy_x", "proxy_y", "proxy_z", "contacts", "force_x",
                                        "force_y", "force_z", "ns"};
  EXPECT_EQ(rows[0], header);
  std::size_t steps = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), header.size());
    const bool last = i + 1 == rows.size() || rows[i + 1][0] != rows[i][0];
    EXPECT_EQ(rows[i][8].empty(), !last);
    EXPECT_EQ(rows[i][12].empty(), !last);
    if (!last) continue;
    EXPECT_EQ(rows[i][0], std::to_string(steps++))
        << "each step has a last piece, also where the proxy rests";
    const double force = std::atof(rows[i][11].c_str());
    if (steps == 1 || steps == 4) {
      EXPECT_EQ(rows[i][8], "0");
      EXPECT_EQ(rows[i][11], "") << "free";
    } else {
      EXPECT_EQ(rows[i][8], "1");
      EXPECT_NEAR(std::atof(rows[i][7].c_str()), 0.75, 1e-12)
          << "the cube's face is at half, the ball a quarter off";
      EXPECT_NEAR(force, 1000 * 0.65, 1e-9) << "stiffness times proxy less goal";
    }
  }
  EXPECT_EQ(steps, 4U);
}

TEST(ProxyCommand, StartsAtTheFirstGoalThatIsFree) {
  const TemporaryFolder folder;
  folder.file("motion.csv", "x,y,z\n0,0,0.5\n0,0,0.75\n0.125,0,2\n0,0,3\n");
  const auto rows = traced_over_a_cube(folder, "certified");
  ASSERT_GE(rows.size(), 5U);
  EXPECT_EQ(rows.back()[7], "3") << "the last goal is free and reached";
  EXPECT_EQ(rows.back()[8], "0");
  for (std::size_t i = 1; i < rows.size(); ++i)
    EXPECT_GT(std::atof(rows[i][7].c_str()), 0.75) << "never inside";
}

// Down onto a cube's top beside its middle, in the corner where x and y are positive: so the normals of its
// vertices lean there, and so does what is interpolated between them.
TEST(ProxyCommand, ShadingTurnsTheForceAndLeavesTheWay) {
  const TemporaryFolder folder;
  folder.file("motion.csv", "x,y,z\n0.3,0.2,0.9\n0.3,0.2,0.7\n0.3,0.2,0.6\n0.3,0.2,0.5\n");
  const auto trace = [&](const std::string& shading) {
    const Outcome outcome = run_touchmark({"proxy", "--method", "certified", "--mesh", "cube", "--trajectory",
                                           folder.file("motion.csv"), "--radius", "0.25", "--shading",
                                           shading, "--trace", folder.file("trace.csv")});
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
    return table_in(folder.file("trace.csv"));
  };
  const auto plain = trace("0"), shaded = trace("1");
  ASSERT_EQ(plain.size(), shaded.size());
  std::size_t turned = 0;
  for (std::size_t i = 1; i < plain.size(); ++i) {
    for (std::size_t column = 0; column < 9; ++column) EXPECT_EQ(plain[i][column], shaded[i][column]);
    if (plain[i][9].empty()) continue;  // free, or not the last piece of its step
    ++turned;
    const auto force = [i](const auto& rows) {
      return Vec3(std::atof(rows[i][9].c_str()), std::atof(rows[i][10].c_str()),
                  std::atof(rows[i][11].c_str()));
    };
    EXPECT_NEAR(force(plain).head<2>().norm(), 0, 1e-9) << "the face's normal";
    EXPECT_GT(force(shaded).x(), 0.1 * force(shaded).z());
    EXPECT_GT(force(shaded).y(), 0.1 * force(shaded).z());
    EXPECT_GT(force(shaded).z(), 0);
    EXPECT_NEAR(force(shaded).norm(), force(plain).norm(), 1e-9 * force(plain).norm());
  }
  EXPECT_EQ(turned, 3U);
}

TEST(ProxyCommand, StartsFreeOutwardFromTheFirstGoalWhereNoGoalIsFree) {
  // Above the cube's upper face, z = 0.5, within the radius; and inside of it.
  for (const char* first : {"0.625", "0.5", "0.45"}) {
    const TemporaryFolder folder;
    folder.file("motion.csv", "x,y,z\n0,0," + std::string(first) + "\n0.1,0,0.6\n0.2,0,0.55\n");
    const auto rows = traced_over_a_cube(folder, "certified");
    ASSERT_GE(rows.size(), 4U);
    for (std::size_t i = 1; i < rows.size(); ++i) {
      EXPECT_GT(std::atof(rows[i][7].c_str()), 0.75) << "the ball is off the face";
      EXPECT_LT(std::atof(rows[i][7].c_str()), 0.75 + 1e-5);
    }
    EXPECT_NEAR(std::atof(rows.back()[5].c_str()), 0.2, 1e-9) << "it follows its goal along the face";
  }
}

TEST(ProxyCommand, MovesOnASlideOfWhichNoGoalIsFree) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run_touchmark({"proxy", "--method", "certified", "--mesh", "torus:20x10", "--trajectory", "slide",
                     "--radius", "1%", "--ticks", "300", "--trace", folder.file("trace.csv")});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const auto rows = table_in(folder.file("trace.csv"));
  std::set<std::array<std::string, 3>> places;
  for (std::size_t i = 1; i < rows.size(); ++i) places.insert({rows[i][5], rows[i][6], rows[i][7]});
  EXPECT_GE(places.size(), 250U) << "a proxy that is stuck rests";
}

TEST(ProxyCommand, CertifiedCrossesNothingOverAScenesOwnMotion) {
  for (const char* mesh : {"torus:20x10", "sliver-fan", "cube"}) {
    for (const char* radius : {"0", "1%"}) {
      const Outcome outcome = run_touchmark({"proxy", "--method", "certified", "--mesh", mesh, "--trajectory",
                                             "cross", "--radius", radius, "--ticks", "500"});
      EXPECT_EQ(outcome.status, 0) << mesh << outcome.out << outcome.err;
    }
  }
}

TEST(ProxyCommand, NamesWhatIsWrong) {
  expect_bad_input({"proxy", "--method", "god-objekt"}, {"god-objekt", "god-object"});
  expect_bad_input({"proxy", "--family", "needles"}, {"needles", "needle-fans"});
  expect_bad_input({"proxy", "--ticks", "none"}, {"--ticks", "none"});
  expect_bad_input({"proxy", "--stiffness", "-1"}, {"--stiffness", "-1"});
  expect_bad_input({"proxy", "--friction", "0.5,x"}, {"--friction", "x"});
  expect_bad_input({"proxy", "--mesh", "cube"}, {"--mesh", "--trajectory"});
  expect_bad_input({"proxy", "--trace", "t.csv"}, {"--trace", "--method"});
  expect_bad_input({"proxy", "--method", "finger-proxy:epsilon=far"}, {"epsilon", "far"});
  expect_bad_input({"proxy", "--method", "virtual-proxy:queries=fcl", "--family", "stabs", "--ticks", "100"},
                   {"fcl", "sweep"});
}

}  // namespace
}  // namespace touchmark::bench::cli
