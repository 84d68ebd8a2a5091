/// `touchmark mesh subdivide` and `touchmark mesh measure`, end to end.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bench/meshes/mesh_writer.h"
#include "bench/support/failures.h"
#include "core/mesh_io/mesh_io.h"
#include "core/subdivision/subdivision.h"
#include "tests/bench/cli/run_touchmark.h"

namespace touchmark::bench::cli {
namespace {

bool has_line(const std::string& text, const std::string& line) {
  return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
}

/// Doubles with all their digits, none of them a float.
TriangleMesh awkward() {
  return TriangleMesh({{1. / 3, -1e-17, 1e300}, {0.1, 1234567.0000000001, -0.}, {-5e-324, 3, 2}, {7, 8, 9}},
                      {{0, 1, 2}, {2, 1, 3}});
}

TEST(MeshWriter, KeepsEveryBitInEveryFormat) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = awkward();
  for (const char* name : {"a.ply", "a.obj", "a.off", "a.stl", "A.PLY"}) {
    const std::string path = folder.file(name);
    meshes::write_mesh(mesh, path);
    const TriangleMesh read = load_mesh(path);
    ASSERT_EQ(read.size(), mesh.size()) << name;
    for (std::size_t t = 0; t < mesh.size(); ++t) {
      EXPECT_EQ(read.id(t), t);
      for (int i = 0; i < 3; ++i) EXPECT_EQ(read.corner(t, i), mesh.corner(t, i)) << name;
    }
  }
  EXPECT_EQ(folder.entries(), 5u);
}

TEST(MeshWriter, RefusesAnEndingItDoesNotKnow) {
  const TemporaryFolder folder;
  EXPECT_THROW(meshes::write_mesh(awkward(), folder.file("mesh.fbx")), std::invalid_argument);
  EXPECT_THROW(meshes::write_mesh(awkward(), folder.file("ply")), std::invalid_argument);
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(MeshWriter, LeavesNothingWhereItCannotWrite) {
  EXPECT_THROW(meshes::write_mesh(awkward(), "/no-such-folder/mesh.ply"), support::ResourceError);
}

std::vector<std::string> command(const std::string& mesh, const std::string& method,
                                 const std::string& output) {
  return {"mesh", "subdivide", "--mesh", mesh, "--method", method, "--levels", "2", "--output", output};
}

TEST(MeshSubdivide, WritesTheMeshThatTheLibraryMakes) {
  const TemporaryFolder folder;
  const std::string coarse_file = folder.file("coarse.ply");
  meshes::write_mesh(TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                  {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}),
                     coarse_file);
  const TriangleMesh coarse = load_mesh(coarse_file);
  for (const char* method :
       {"butterfly", "catmull-clark", "catmull-clark-linear", "mid-point", "loop", "ls3"}) {
    const std::string output = folder.file("fine.ply");
    const Outcome outcome = run_touchmark(command(coarse_file, method, output));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    const TriangleMesh expected = subdivide(coarse, {.method = *subdivision_method(method), .levels = 2});
    const TriangleMesh fine = load_mesh(output);
    EXPECT_TRUE(std::ranges::equal(fine.vertices(), expected.vertices())) << method;
    EXPECT_TRUE(std::ranges::equal(fine.triangles(), expected.triangles())) << method;
    EXPECT_TRUE(has_line(outcome.out, "triangles: " + std::to_string(expected.size()))) << outcome.out;
    EXPECT_TRUE(has_line(outcome.out, "form: published")) << outcome.out;
  }
}

TEST(MeshSubdivide, TakesTheThresholdInPercentOfTheInputsDiagonal) {
  // The cube's box diagonal is sqrt(3): its edges are 57.7 % of it, its faces' diagonals 81.6 %.
  const TemporaryFolder folder;
  const auto triangles = [&](const std::string& threshold, const std::string& levels) {
    std::vector<std::string> words = command("cube", "mid-point", folder.file("out.off"));
    words[7] = levels;
    words.insert(words.end(), {"--threshold", threshold});
    const Outcome outcome = run_touchmark(words);
    EXPECT_TRUE(has_line(outcome.out, "form: meshlab")) << outcome.out << outcome.err;
    return load_mesh(folder.file("out.off")).size();
  };
  EXPECT_EQ(triangles("82%", "1"), 12u);
  EXPECT_EQ(triangles("81%", "1"), 24u);
  EXPECT_EQ(triangles("1.4", "1"), 24u);
  EXPECT_EQ(triangles("57%", "1"), 48u);
  EXPECT_EQ(triangles("57%", "3"), 48u);
}

TEST(MeshSubdivide, TakesAFormInPlaceOfTheDefault) {
  const TemporaryFolder folder;
  std::vector<std::string> words = command("icosphere:0", "butterfly", folder.file("out.ply"));
  words.insert(words.end(), {"--form", "meshlab"});
  ASSERT_EQ(run_touchmark(words).status, 0);
  const TriangleMesh fine = load_mesh(folder.file("out.ply"));
  EXPECT_TRUE(std::ranges::all_of(fine.vertices(),
                                  [](const Vec3& v) { return v == v.cast<float>().cast<double>(); }));
}

TEST(MeshSubdivide, SaysWhatItDoesToSeams) {
  const TemporaryFolder folder;
  const std::string book =
      folder.file("book.off", "OFF 5 3 0\n0 0 0\n0 0 1\n1 0 0\n0 1 0\n-1 -1 0\n3 0 1 2\n3 1 0 3\n3 0 1 4\n");
  const Outcome outcome = run_touchmark(command(book, "loop", folder.file("out.ply")));
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.err.find("1 of the edges"), std::string::npos) << outcome.err;
}

TEST(MeshSubdivide, RefusesBadInputInOneLineAndWritesNothing) {
  const TemporaryFolder folder;
  const std::string out = folder.file("out.ply");
  expect_bad_input({"mesh", "subdivide", "cube", "--method", "loop", "--levels", "1"}, {"--output"});
  expect_bad_input({"mesh", "subdivide", "cube", "--method", "loop", "--output", out}, {"--levels"});
  expect_bad_input({"mesh", "subdivide", "cube", "--levels", "1", "--output", out}, {"--method"});
  expect_bad_input({"mesh", "subdivide", "cube", "--method", "doo-sabin", "--levels", "1", "--output", out},
                   {"--method", "doo-sabin"});
  for (const char* levels : {"-1", "1.5", "two", "99999999999"}) {
    expect_bad_input({"mesh", "subdivide", "cube", "--method", "loop", "--levels", levels, "--output", out},
                     {"--levels", levels});
  }
  for (const char* threshold : {"-1%", "nan", "x", "1%%"}) {
    std::vector<std::string> words = command("cube", "loop", out);
    words.insert(words.end(), {"--threshold", threshold});
    expect_bad_input(words, {"--threshold", threshold});
  }
  expect_bad_input({"mesh", "subdivide", "cube", "--method", "loop", "--levels", "40", "--output", out},
                   {"level 11 of loop", "50331648", "50000000"});
  expect_bad_input(command("cube", "loop", folder.file("out.xyz")), {"out.xyz", ".ply"});
  expect_bad_input(command(folder.file("missing.ply"), "loop", out), {"missing.ply"});
  EXPECT_EQ(folder.entries(), 0u);
}

TEST(MeshSubdivide, AFileThatCannotBeWrittenIsStatusThree) {
  const Outcome outcome = run_touchmark(command("cube", "loop", "/no-such-folder/out.ply"));
  EXPECT_EQ(outcome.status, 3);
  EXPECT_NE(outcome.err.find("/no-such-folder/out.ply"), std::string::npos) << outcome.err;
}

TEST(MeshSubdivide, ShowsAnExample) {
  const Outcome outcome = run_touchmark({"mesh", "subdivide", "--help"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.out.find("Example: touchmark mesh subdivide"), std::string::npos) << outcome.out;
}

TEST(MeshSubdivide, MakesThePapersCounts) {
  const std::filesystem::path bunny = std::filesystem::path(TOUCHMARK_SHARED_MODELS) / "bunny-902.ply";
  if (!std::filesystem::exists(bunny)) GTEST_SKIP() << bunny << " is not there";
  struct Counts {
    const char* method;
    std::array<std::size_t, 3> triangles;
  };
  const TemporaryFolder folder;
  for (const Counts& row :
       {Counts{"butterfly", {3580, 13620, 41768}}, Counts{"catmull-clark-linear", {5412, 21648, 86592}},
        Counts{"mid-point", {3580, 13590, 41120}}, Counts{"loop", {3580, 13600, 38444}},
        Counts{"ls3", {3580, 13668, 40730}}}) {
    for (std::size_t level = 1; level <= 3; ++level) {
      const std::string output = folder.file("fine.ply");
      const Outcome outcome =
          run_touchmark({"mesh", "subdivide", "--mesh", bunny.string(), "--method", row.method, "--levels",
                         std::to_string(level), "--threshold", "1%", "--output", output});
      EXPECT_EQ(load_mesh(output).size(), row.triangles[level - 1]) << row.method << outcome.err;
    }
  }
}

TEST(MeshMeasure, PrintsOneLineAMeasure) {
  const Outcome outcome = run_touchmark({"mesh", "measure", "cube"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  for (const char* line :
       {"triangles: 12", "area: 6", "mean_triangle_area: 0.5", "signed_volume: 1", "absolute_volume: 1",
        "edges: 18", "boundary_edges: 0", "seam_edges: 0", "closed: yes", "shortest_edge: 1"}) {
    EXPECT_TRUE(has_line(outcome.out, line)) << line << "\n" << outcome.out;
  }
}

TEST(MeshMeasure, TakesTheCentreOfThePapersVolume) {
  const nlohmann::json json =
      nlohmann::json::parse(run_touchmark({"mesh", "measure", "cube", "--center", "2.5,0,0", "--json"}).out);
  // The six pyramids' heights are 2, 3 and four times 1/2.
  EXPECT_NEAR(json["absolute_volume"].get<double>(), (2 + 3 + 4 * 0.5) / 3, 1e-15);
  EXPECT_NEAR(json["signed_volume"].get<double>(), 1, 1e-15);
}

TEST(MeshMeasure, FindsTheTightnessOfASingleTriangle) {
  const TemporaryFolder folder;
  const std::string file = folder.file("t.off", "OFF 3 1 0\n0 0 0\n3 0 0\n0 6 0\n3 0 1 2\n");
  const nlohmann::json json = nlohmann::json::parse(run_touchmark({"mesh", "measure", file, "--json"}).out);
  EXPECT_NEAR(json["tightness"].get<double>(), std::sqrt(17), 1e-14);
  EXPECT_EQ(json["closed"], false);
}

TEST(MeshMeasure, RefusesBadInputInOneLine) {
  for (const char* center : {"1,2", "1,2,3,4", "a,b,c", "1,,3", "inf,0,0"})
    expect_bad_input({"mesh", "measure", "cube", "--center", center}, {"--center", center});
  expect_bad_input({"mesh", "measure"}, {"mesh"});
}

}  // namespace
}  // namespace touchmark::bench::cli
