#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/bench/cli/run_touchmark.h"

namespace touchmark::bench::cli {
namespace {

TEST(MeshInfo, PrintsOneLineAMeasure) {
  const Outcome outcome = run_touchmark({"mesh", "info", "--mesh", "cube"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  for (const char* line : {"triangles: 12\n", "vertices: 8\n", "bounds_min: -0.5 -0.5 -0.5\n", "edges: 18\n",
                           "boundary_edges: 0\n", "closed: yes\n", "oriented: yes\n", "area: 6\n",
                           "volume: 1\n", "shortest_edge: 1\n", "degenerate_triangles: 0\n"}) {
    EXPECT_NE(outcome.out.find(line), std::string::npos) << line << outcome.out;
  }
}

TEST(MeshInfo, TakesTheMeshAsAWordToo) {
  EXPECT_EQ(run_touchmark({"mesh", "info", "cube"}).out,
            run_touchmark({"mesh", "info", "--mesh", "cube"}).out);
}

TEST(MeshInfo, NormalizeScalesTheDiagonalToOne) {
  EXPECT_NE(
      run_touchmark({"mesh", "info", "single-triangle@offset=1000", "--normalize"}).out.find("diagonal: 1\n"),
      std::string::npos);
}

TEST(MeshInfo, SaysTheSameInJson) {
  const nlohmann::json json =
      nlohmann::json::parse(run_touchmark({"mesh", "info", "torus:8x6", "--json"}).out);
  EXPECT_EQ(json["triangles"], 96);
  EXPECT_EQ(json["euler_characteristic"], 0);
  EXPECT_EQ(json["closed"], true);
  EXPECT_TRUE(json["volume"].is_number());
  EXPECT_TRUE(
      nlohmann::json::parse(run_touchmark({"mesh", "info", "soup:3", "--json"}).out)["volume"].is_null());
}

TEST(MeshInfo, SaysHowInsideIsToldFromOutside) {
  const auto info = [](const char* mesh) {
    return nlohmann::json::parse(run_touchmark({"mesh", "info", mesh, "--json"}).out);
  };
  const nlohmann::json cube = info("cube"), triangle = info("single-triangle"), doubled = info("doubled");
  EXPECT_EQ(cube["sides_by"], "pseudonormals");
  EXPECT_EQ(cube["simple_triangles"], 12);
  EXPECT_EQ(cube["inside_out"], false);
  EXPECT_EQ(triangle["sides_by"], "winding_number");
  EXPECT_EQ(triangle["open_edges"], 3);
  EXPECT_EQ(doubled["sides_by"], "crossings");
  EXPECT_NE(run_touchmark({"mesh", "info", "cube"}).out.find("sides_by: pseudonormals\n"), std::string::npos);
}

TEST(MeshInfo, CountsAFilesPolygonsAsFaces) {
  const TemporaryFolder folder;
  const std::string path = folder.file("square.off", "OFF\n4 1 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n4 0 1 2 3\n");
  const std::string out = run_touchmark({"mesh", "info", path}).out;
  EXPECT_NE(out.find("triangles: 2\n"), std::string::npos) << out;
  EXPECT_NE(out.find("faces: 1\n"), std::string::npos) << out;
  EXPECT_NE(out.find("area: 4\n"), std::string::npos) << out;
  EXPECT_EQ(out.find("volume"), std::string::npos) << out;
}

TEST(MeshInfo, SaysTheAxesAndTheUnitOfAFile) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.off", "OFF\n3 1 0\n0 0 0\n2 0 0\n2 2 0\n3 0 1 2\n");
  EXPECT_TRUE(run_touchmark({"mesh", "info", path}).out.ends_with("axes: as written\nunit: none stated\n"));
  const nlohmann::json in_mm =
      nlohmann::json::parse(run_touchmark({"mesh", "info", path, "--unit", "mm", "--json"}).out);
  EXPECT_EQ(in_mm["axes"], "as written");
  EXPECT_EQ(in_mm["unit"], "mm");
  EXPECT_EQ(run_touchmark({"mesh", "info", "cube"}).out.find("axes"), std::string::npos);
}

TEST(MeshInfo, RefusesBadInputInOneLine) {
  const TemporaryFolder folder;
  expect_bad_input({"mesh"}, {});
  expect_bad_input({"mesh", "info"}, {"mesh"});
  expect_bad_input({"mesh", "info", "cube", "wedge"}, {"wedge"});
  expect_bad_input({"mesh", "info", "no-such-scene"}, {"no-such-scene"});
  expect_bad_input({"mesh", "info", "icosphere:99"}, {"icosphere:99", "11"});
  expect_bad_input({"mesh", "info", "noisy-sphere:200000001"}, {"200000001", "200000000"});
  expect_bad_input({"mesh", "info", "cube@scale=0"}, {"@scale", "0"});
  expect_bad_input({"mesh", "info", folder.file("missing.ply")}, {"missing.ply"});
  expect_bad_input({"mesh", "info", folder.path()}, {folder.path(), "directory"});
  expect_bad_input({"mesh", "info", "-"}, {"\"-\"", "standard input is not read"});
  expect_bad_input({"mesh", "info", folder.file("empty.ply", "")}, {"empty.ply", "empty"});
  expect_bad_input({"mesh", "info", folder.file("cut.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")},
                   {"cut.obj", "line 4", "9"});
  expect_bad_input({"mesh", "info", folder.file("nan.off", "OFF 3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n")},
                   {"nan.off", "line 3", "nan"});
}

TEST(MeshInfo, AFullDiskIsStatusThree) {
  const Outcome outcome = run_touchmark({"mesh", "info", "cube"}, "/dev/full");
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("standard output"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace touchmark::bench::cli
