// Scenes of bodies as a user meets them: files, motions, rows and errors.
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/bench/cli/csv_fields.h"
#include "tests/bench/cli/run_touchmark.h"

namespace touchmark::bench::cli {
namespace {

namespace fs = std::filesystem;

class SceneCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("touchmark_scene_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    write("plate.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::string scene(const std::string& bodies) {
    return write("scene.json", R"({"bodies":[)" + bodies + "]}");
  }
  static std::string plate(const std::string& name, const std::string& position,
                           const std::string& orientation = "[1,0,0,0]") {
    return R"({"name":")" + name + R"(","mesh":"plate.off","position":)" + position + R"(,"orientation":)" +
           orientation + "}";
  }
  /// The rows' last fields, and their distances.
  struct Rows {
    std::vector<std::string> bodies, distances, triangles;
  };
  Rows rows(const std::string& scene, const std::string& motion, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments{"query",      "--scene",        scene,      "--trajectory", motion,
                                       "--detector", "sphere-cluster", "--radius", "0.5",          "--reach",
                                       "inf"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const std::string csv = (folder_ / "rows.csv").string();
    arguments.insert(arguments.end(), {"--csv", csv});
    const Outcome outcome = run_touchmark(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    Rows found;
    for (const Fields& fields : fields_in(csv, {"triangle", "distance", "body"})) {
      found.triangles.push_back(fields[0]);
      found.distances.push_back(fields[1]);
      found.bodies.push_back(fields[2]);
    }
    return found;
  }

  fs::path folder_;
};

TEST_F(SceneCommand, NamesTheNearestBodyAndOfSeveralTheFirst) {
  const std::string three =
      scene(plate("low", "[0,0,0]") + "," + plate("first", "[0,0,4]") + "," + plate("second", "[0,0,4]"));
  const std::string motion = write("motion.csv", "x,y,z\n0.25,0.25,1\n0.25,0.25,3\n0.25,0.25,2\n");
  const Rows found = rows(three, motion);
  EXPECT_EQ(found.bodies, (std::vector<std::string>{"low", "first", "low"}));
  EXPECT_EQ(found.distances, (std::vector<std::string>{"1", "1", "2"}));
}

// A quarter turn about z takes the plate's corner (1, 0, 0) to (0, 1, 0), and (0, 1, 0) to (-1, 0, 0).
TEST_F(SceneCommand, TurnsByTheQuaternionWhateverItsLength) {
  const std::string turned = scene(plate("turned", "[0,0,0]", "[3,0,0,3]"));
  const std::string motion = write("motion.csv", "x,y,z\n-2,0,0\n1,0,0\n");
  const Rows found = rows(turned, motion);
  EXPECT_NEAR(std::stod(found.distances[0]), 1, 1e-15);
  EXPECT_NEAR(std::stod(found.distances[1]), 1, 1e-15);
}

TEST_F(SceneCommand, MovesLinearlyBetweenRowsAndHoldsBeforeAndAfter) {
  const std::string one = scene(plate("moved", "[0,0,9]") + "," + plate("far", "[100,0,0]"));
  const std::string poses = write("poses.csv",
                                  "time_s,body,x,y,z,qw,qx,qy,qz\n1,moved,0,0,1,1,0,0,0\n"
                                  "2,moved,0,0,3,1,0,0,0\n");
  const std::string motion =
      write("motion.csv", "time_s,x,y,z\n0,0,0,0\n1,0,0,0\n1.25,0,0,0\n2,0,0,0\n7,0,0,0\n");
  EXPECT_EQ(rows(one, motion, {"--poses", poses}).distances,
            (std::vector<std::string>{"1", "1", "1.5", "3", "3"}));
}

// Half of a half turn about z: by slerp a quarter turn, and not the chord's anything.
TEST_F(SceneCommand, TurnsBySlerpBetweenRows) {
  const std::string one = scene(plate("moved", "[0,0,0]"));
  const std::string poses = write("poses.csv",
                                  "time_s,body,x,y,z,qw,qx,qy,qz\n0,moved,0,0,0,1,0,0,0\n"
                                  "0.009,moved,0,0,0,0.70710678118654757,0,0,0.70710678118654757\n");
  // At a third of a quarter turn the corner (1, 0, 0) is at 30 degrees. A step is a millisecond.
  const std::string motion = write("motion.csv", "x,y,z\n2,0,0\n9,9,9\n9,9,9\n1.7320508075688772,1,0\n");
  const Rows found = rows(one, motion, {"--poses", poses});
  EXPECT_NEAR(std::stod(found.distances[0]), 1, 1e-15);
  EXPECT_NEAR(std::stod(found.distances[3]), 1, 1e-14);
}

TEST_F(SceneCommand, TakesTheRateOfStepsWithoutTimes) {
  const std::string one = scene(plate("moved", "[0,0,0]"));
  const std::string poses =
      write("poses.csv", "time_s,body,x,y,z,qw,qx,qy,qz\n0,moved,0,0,0,1,0,0,0\n1,moved,0,0,8,1,0,0,0\n");
  const std::string motion = write("motion.csv", "x,y,z\n0,0,0\n0,0,0\n0,0,0\n");
  EXPECT_EQ(rows(one, motion, {"--poses", poses, "--rate", "2"}).distances,
            (std::vector<std::string>{"0", "4", "8"}));
}

TEST_F(SceneCommand, RefusesWhatIsNoSceneInOneLine) {
  const std::string motion = write("motion.csv", "x,y,z\n0,0,0\n");
  const auto refuses = [&](const std::string& text, const std::vector<std::string>& named) {
    expect_bad_input(
        {"query", "--scene", write("scene.json", text), "--trajectory", motion, "--detector", "brute-force"},
        named);
  };
  const std::string good = plate("a", "[0,0,0]");
  refuses("{", {"scene.json", "not JSON"});
  refuses(R"({"bodies":[]})", {"bodies"});
  refuses(R"({"bodies":[)" + good + R"(],"units":"mm"})", {"units"});
  refuses(R"({"bodies":[)" + good + "," + good + "]}", {"\"a\"", "name"});
  refuses(R"({"bodies":[{"name":"a","mesh":"plate.off","position":[0,0,0]}]})", {"orientation", "missing"});
  refuses(R"({"bodies":[)" + plate("a", "[0,0]") + "]}", {"position", "2", "3"});
  refuses(R"({"bodies":[)" + plate("a", "[0,0,1e999]") + "]}", {"scene.json"});
  refuses(R"({"bodies":[)" + plate("a", "[0,0,\"x\"]") + "]}", {"position"});
  refuses(R"({"bodies":[)" + plate("a", "[0,0,0]", "[0,0,0,0]") + "]}", {"orientation", "zeros"});
  refuses(
      R"({"bodies":[{"name":"a","name":"b","mesh":"plate.off","position":[0,0,0],"orientation":[1,0,0,0]}]})",
      {"name", "twice"});
  refuses(R"({"bodies":[{"name":"a","mesh":"none.off","position":[0,0,0],"orientation":[1,0,0,0]}]})",
          {"none.off"});
}

// A box of 2 x 4 x 6 turned by a quarter turn about z, over a floor.
TEST_F(SceneCommand, TakesBoxesAndPlanesOfTheSizesWritten) {
  const std::string two =
      scene(R"({"name":"box","shape":"box","size":[2,4,6],"position":[10,0,0],"orientation":[1,0,0,1]},)"
            R"({"name":"floor","shape":"plane","size":[8,2],"position":[0,0,-5],"orientation":[1,0,0,0]})");
  const std::string motion =
      write("motion.csv", "x,y,z\n7,0,0\n10,3,0\n10,0,5\n10,0,0\n0,0,-3.5\n5,0,-5\n0,1.5,-5\n");
  const Rows found = rows(two, motion);
  EXPECT_EQ(found.bodies, (std::vector<std::string>{"box", "box", "box", "box", "floor", "floor", "floor"}));
  const std::vector<double> distances{1, 2, 2, 1, 1.5, 1, 0.5};
  for (std::size_t i = 0; i < distances.size(); ++i)
    EXPECT_NEAR(std::stod(found.distances.at(i)), distances[i], 1e-14) << i;
  const Outcome verified =
      run_touchmark({"verify", "--scene", two, "--steps", "40", "--trajectory", "slide"});
  EXPECT_EQ(verified.status, 0) << verified.out << verified.err;
}

// A sphere of radius 2, whose surface is what counts, and a capsule of 4 + 2 x 1 that lies along x.
TEST_F(SceneCommand, TakesSpheresAndCapsulesAsSurfaces) {
  const std::string two = scene(
      R"({"name":"ball","shape":"sphere","radius":2,"position":[0,0,0],"orientation":[1,0,0,0]},)"
      R"({"name":"bar","shape":"capsule","radius":1,"length":4,"position":[10,0,0],"orientation":[1,0,1,0]})");
  const std::string motion = write("motion.csv", "x,y,z\n0,0,5\n0,1.5,0\n0,0,0\n10,0,3\n15,0,0\n10,0,0\n");
  const Rows found = rows(two, motion);
  EXPECT_EQ(found.bodies, (std::vector<std::string>{"ball", "ball", "ball", "bar", "bar", "bar"}));
  const std::vector<double> distances{3, 0.5, 2, 2, 2, 1};
  for (std::size_t i = 0; i < distances.size(); ++i)
    EXPECT_NEAR(std::stod(found.distances.at(i)), distances[i], 1e-14) << i;
}

// Moving and still, beside a mesh, by way of every query. Who takes triangles alone says so.
TEST_F(SceneCommand, VerifiesRoundBodiesExactly) {
  const std::string many = scene(
      plate("plate", "[0,0,0]") + "," +
      R"({"name":"ball","shape":"sphere","radius":0.5,"position":[0.2,0,0.5],"orientation":[1,0,0,0]},)"
      R"({"name":"twin","shape":"sphere","radius":0.5,"position":[0.2,0,0.5],"orientation":[1,0,1,0]},)"
      R"({"name":"bar","shape":"capsule","radius":0.3,"length":2,"position":[1,1,0],"orientation":[1,0.2,1,0]})");
  const std::string poses = write("poses.csv",
                                  "time_s,body,x,y,z,qw,qx,qy,qz\n0,bar,1,1,0,1,0.2,1,0\n"
                                  "0.05,bar,0,0,0.1,1,0,0,0\n");
  const Outcome outcome =
      run_touchmark({"verify", "--scene", many, "--poses", poses, "--steps", "60", "--trajectory", "jump",
                     "--trajectory", "slide", "--radius", "2%", "--detector", "sphere-cluster", "--detector",
                     "brute-force", "--detector", "looped"});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("720 answers judged exactly"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("nothing judged"), std::string::npos) << outcome.out;
}

// Forty boxes in a row, no two of a size; the probe stays over the first three, at the end one comes to it.
TEST_F(SceneCommand, BuildsTheShapesThatAreEverNearAndSaysHowMany) {
  std::string row;
  for (int i = 0; i < 40; ++i)
    row += (i > 0 ? "," : "") + (R"({"name":"b)" + std::to_string(i)) + R"(","shape":"box","size":[1,1,)" +
           std::to_string(1 + 0.001 * i) + R"(],"position":[)" + std::to_string(10 * i) +
           R"(,0,0],"orientation":[1,0,0,0]})";
  const std::string many = scene(row);
  const std::string motion = write("motion.csv", "x,y,z\n0,0,1\n10,0,1\n20,0,1\n20,0,90\n");
  const std::string poses = write("poses.csv",
                                  "time_s,body,x,y,z,qw,qx,qy,qz\n0.002,b30,300,0,0,1,0,0,0\n"
                                  "0.003,b30,20,0,88,1,0,0,0\n");
  const auto remarks = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"query",    "--scene", many,         "--trajectory",  motion,
                                       "--radius", "3",       "--detector", "sphere-cluster"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_touchmark(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return outcome.err;
  };
  EXPECT_NE(remarks({}).find("3 of 40 shapes are built"), std::string::npos) << remarks({});
  EXPECT_NE(remarks({"--poses", poses}).find("4 of 40 shapes are built"), std::string::npos);
  // The way between two steps passes all that is in between.
  EXPECT_NE(remarks({"--query", "sweep"}).find("3 of 40 shapes are built"), std::string::npos);
  EXPECT_NE(remarks({"--reach", "inf"}).find(" of 40 shapes are built"), std::string::npos);
  const std::string jump = write("jump.csv", "x,y,z\n0,0,1\n390,0,1\n");
  EXPECT_EQ(run_touchmark({"query", "--scene", many, "--trajectory", jump, "--radius", "3", "--query",
                           "sweep", "--detector", "sphere-cluster"})
                .err.find("shapes are built"),
            std::string::npos);
  const Outcome verified = run_touchmark({"verify", "--scene", many, "--poses", poses, "--trajectory", motion,
                                          "--radius", "3", "--detector", "sphere-cluster"});
  EXPECT_EQ(verified.status, 0) << verified.out << verified.err;
}

TEST_F(SceneCommand, RefusesShapesAndSizesThatAreNoneInOneLine) {
  const std::string motion = write("motion.csv", "x,y,z\n0,0,0\n");
  const auto refuses = [&](const std::string& members, const std::vector<std::string>& named) {
    expect_bad_input({"query", "--scene",
                      scene(R"({"name":"a","position":[0,0,0],"orientation":[1,0,0,0],)" + members + "}"),
                      "--trajectory", motion, "--detector", "brute-force"},
                     named);
  };
  refuses(R"("shape":"cone","size":[1,1,1])", {"\"a\"", "cone", "plane, box, sphere, capsule"});
  refuses(R"("shape":"box","size":[1,1])", {"\"a\"", "size", "2", "3"});
  refuses(R"("shape":"box","size":[1,-1,1])", {"\"a\"", "size", "number 2", "-1"});
  refuses(R"("shape":"box","size":[1,0,1])", {"size", "number 2"});
  refuses(R"("shape":"box","size":[1,1e300,1])", {"size", "number 2", "1e+30"});
  refuses(R"("shape":"box","size":4)", {"size", "list"});
  refuses(R"("shape":"box")", {"size", "missing"});
  refuses(R"("shape":"box","size":[1,1,1],"mesh":"cube")", {"mesh", "shape"});
  refuses(R"("shape":7)", {"shape", "text"});
  refuses(R"("shape":"sphere","radius":0)", {"\"a\"", "radius", "0"});
  refuses(R"("shape":"sphere","radius":[1])", {"radius", "number"});
  refuses(R"("shape":"sphere","size":[1,1,1])", {"size"});
  refuses(R"("shape":"capsule","radius":1)", {"length", "missing"});
  refuses(R"("shape":"capsule","radius":1,"length":-2)", {"length", "-2"});
  refuses(R"("mesh":"cube","size":[1,1,1])", {"size"});
}

TEST_F(SceneCommand, RefusesPosesThatFitNoScene) {
  const std::string one = scene(plate("a", "[0,0,0]"));
  const std::string motion = write("motion.csv", "x,y,z\n0,0,0\n");
  const auto refuses = [&](const std::string& rows, const std::vector<std::string>& named) {
    expect_bad_input(
        {"query", "--scene", one, "--poses", write("poses.csv", "time_s,body,x,y,z,qw,qx,qy,qz\n" + rows),
         "--trajectory", motion, "--detector", "brute-force"},
        named);
  };
  refuses("", {"poses.csv", "no row"});
  refuses("0,b,0,0,0,1,0,0,0\n", {"poses.csv:2", "'b'"});
  refuses("0,a,0,0,nan,1,0,0,0\n", {"poses.csv:2", "column z"});
  refuses("0,a,0,0,0,0,0,0,0\n", {"poses.csv:2", "zeros"});
  refuses("0,a,0,0,0,1,0,0,0\n0,a,0,0,0,1,0,0,0\n", {"poses.csv:3", "time_s"});
  refuses("0,a,0,0,0,1,0,0\n", {"poses.csv:2", "8", "9"});
  // In the middle of a file, after rows that are good.
  const std::string good = "0,a,0,0,0,1,0,0,0\n1,a,0,0,0,2,0,0,0\n";
  refuses(good + "0.5,a,0,0,0,1,0,0,0\n", {"poses.csv:4", "time_s"});
  refuses(good + "2,a,0,0,0,1,inf,0,0\n", {"poses.csv:4", "column qx"});
  refuses(good + "2,a,0,0,0,-0,0,-0,0\n", {"poses.csv:4", "zeros"});
  refuses(good + "2,A,0,0,0,1,0,0,0\n", {"poses.csv:4", "'A'"});
  refuses(good + "nan,a,0,0,0,1,0,0,0\n", {"poses.csv:4", "time_s"});
  expect_bad_input({"query", "--poses", "p.csv", "--detector", "brute-force"}, {"--poses", "--scene"});
  expect_bad_input({"query", "--scene", one, "--mesh", "cube", "--detector", "brute-force"},
                   {"--scene", "--mesh"});
  expect_bad_input({"query", "--scene", "heap:0", "--detector", "brute-force"}, {"heap:0"});
  expect_bad_input({"query", "--scene", "heap:3:motion=mad", "--detector", "brute-force"}, {"mad", "drift"});
  expect_bad_input({"query", "--scene", "hepa", "--detector", "brute-force"}, {"hepa", "heap"});
}

TEST_F(SceneCommand, CommandsOfOneMeshSaySoInOneLine) {
  for (const std::string command : {"stress", "scale", "update"})
    expect_bad_input({command, "--scene", "heap:3"},
                     {command, "--scene", "query, verify, bench, servo, gate and choose"});
  expect_bad_input({"stress", "--poses", "poses.csv"}, {"stress", "--poses"});
}

// Any processor answers within a tenth of a second, warm or cold, whatever else it does. Whose code is no
// class names where it is.
TEST_F(SceneCommand, ChoosesForBodiesThatMoveAndPrintsAScene) {
  const std::string one = scene(plate("moved", "[0,0,0.25]") + "," + plate("still", "[0,0,0]"));
  const std::string poses = write("poses.csv",
                                  "time_s,body,x,y,z,qw,qx,qy,qz\n0,moved,0,0,0.25,1,0,0,0\n"
                                  "20,moved,0,0,0.5,1,0,0,0\n");
  std::string positions = "x,y,z\n";
  for (int i = 0; i < 200; ++i) positions += std::to_string(0.002 * i) + ",0.25,0.002\n";
  const std::string motion = write("motion.csv", positions), out = (folder_ / "chosen").string();
  const Outcome outcome = run_touchmark({"choose", "--scene", one, "--poses", poses, "--motion", motion,
                                         "--rate", "10", "--quick", "--share", "100%", "--detector",
                                         "sphere-cluster", "--detector", "merged", "--out", out});
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("\nrecommended: sphere-cluster"), std::string::npos) << outcome.out;
  for (const char* const code : {"touchmark::Scene<touchmark::SphereCluster>",
                                 "std::optional<touchmark::BodyContact>", "scene_.nearest_body({center, "})
    EXPECT_NE(outcome.out.find(code), std::string::npos) << code << outcome.out;
  const Outcome valid = run_touchmark({"validate", out});
  EXPECT_EQ(valid.status, 0) << valid.out << valid.err;
  const Outcome by_itself =
      run_touchmark({"choose", "--scene", one, "--quick", "--steps", "50", "--detector", "sphere-cluster"});
  EXPECT_NE(by_itself.out.find("motions: hand, approach, hover, cross\n"), std::string::npos)
      << by_itself.out << by_itself.err;
  expect_bad_input({"choose", "--scene", one, "--trajectory", "fast-slide"}, {"fast-slide", "scene"});
  expect_bad_input({"choose", "--scene", one, "--trajectory", "slide", "--rate", "500"}, {"500", "slide"});
  expect_bad_input({"choose", "--poses", poses}, {"--poses", "--scene"});
}

// The bodies and their motion are those of the baseline, or it is refused.
TEST_F(SceneCommand, AGateOverBodiesTakesABaselineOfTheSameOnesAlone) {
  const std::string baseline = (folder_ / "baseline.csv").string();
  const auto gate = [&](const std::string& height, std::vector<std::string> more) {
    const std::string bodies = scene(plate("a", "[0,0,0]") + "," + plate("b", "[0,0," + height + "]"));
    more.insert(more.begin(), {"gate", "--scene", bodies, "--steps", "60", "--detector", "sphere-cluster",
                               "--rounds", "5", "--tolerance", "90%", "--baseline", baseline});
    return run_touchmark(more);
  };
  const Outcome written = gate("0.25", {"--write-baseline"});
  ASSERT_EQ(written.status, 0) << written.out << written.err;
  const Outcome same = gate("0.25", {});
  EXPECT_EQ(same.status, 0) << same.out << same.err;
  const Outcome elsewhere = gate("0.375", {});
  EXPECT_EQ(elsewhere.status, 2);
  EXPECT_NE(elsewhere.err.find("another mesh"), std::string::npos) << elsewhere.err;
  const std::string poses =
      write("moves.csv", "time_s,body,x,y,z,qw,qx,qy,qz\n0,b,0,0,0.25,1,0,0,0\n1,b,0,0,0.5,1,0,0,0\n");
  const Outcome moving = gate("0.25", {"--poses", poses});
  EXPECT_EQ(moving.status, 2) << "its baseline is of bodies that stand";
  EXPECT_NE(moving.err.find("another trajectory"), std::string::npos) << moving.err;
}

TEST_F(SceneCommand, ListsGeneratedScenesAndMotions) {
  const Outcome outcome = run_touchmark({"list"});
  for (const char* const name : {"field:N", "heap:N", "assembly:N", "cloud:N", "motion=drift"})
    EXPECT_NE(outcome.out.find(name), std::string::npos) << name;
}

// A tree of nodes: the child is where its parent takes it. Scales and mirrors are applied to its mesh.
TEST_F(SceneCommand, ReadsTheNodesOfAFile) {
  const auto gltf = [](const std::string& child) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"base","mesh":0,)"
           R"("children":[1],"translation":[0,0,1]},{"name":"tip","mesh":0,)" +
           child +
           R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)"
           R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},)"
           R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],"bufferViews":[)"
           R"({"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],)"
           R"("buffers":[{"byteLength":42,"uri":"data:application/octet-stream;base64,)"
           R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA"}]})";
  };
  const std::string motion = write("motion.csv", "x,y,z\n0.25,0.25,0\n0.25,0.25,9\n");
  const Rows found = rows(write("tree.gltf", gltf(R"("translation":[0,0,3])")), motion);
  EXPECT_EQ(found.bodies, (std::vector<std::string>{"base", "tip"}));
  EXPECT_EQ(found.distances, (std::vector<std::string>{"1", "5"}));
  // Over the larger triangle alone.
  const std::string beside = write("beside.csv", "x,y,z\n0.25,0.25,0\n0.75,0.75,9\n");
  const Rows scaled = rows(write("scaled.gltf", gltf(R"("translation":[0,0,3],"scale":[2,2,-1])")), beside);
  EXPECT_EQ(scaled.bodies, (std::vector<std::string>{"base", "tip"}));
  EXPECT_EQ(scaled.distances, (std::vector<std::string>{"1", "5"}));
}

// An arm whose second joint turns by a quarter turn about z and moves along the turned x. Collision geometry
// comes before the visual one, which is all that the hand has.
TEST_F(SceneCommand, ReadsARobotAtTheZeroPositionsOfItsJoints) {
  const auto robot = [&](const std::string& tip) {
    return write("arm.urdf",
                 R"(<robot name="arm"><link name="base"><visual><geometry><sphere radius="9"/></geometry>)"
                 R"(</visual><collision><geometry><box size="2 2 2"/></geometry></collision></link>)"
                 R"(<link name="elbow"><collision><origin xyz="4 0 0"/><geometry><sphere radius="1"/>)"
                 R"(</geometry></collision><collision><origin xyz="0 4 0"/><geometry>)"
                 R"(<cylinder radius="1" length="2"/></geometry></collision></link><link name="hand">)"
                 R"(<visual><geometry>)" +
                     tip +
                     R"(</geometry></visual></link><joint name="a" type="revolute"><parent link="base"/>)"
                     R"(<child link="elbow"/><origin xyz="10 0 0" rpy="0 0 1.5707963267948966"/>)"
                     R"(<axis xyz="0 0 1"/><limit effort="1" velocity="1" lower="-1" upper="1"/></joint>)"
                     R"(<joint name="b" type="fixed"><parent link="elbow"/><child link="hand"/>)"
                     R"(<origin xyz="20 0 0"/></joint></robot>)");
  };
  const std::string motion = write("motion.csv", "x,y,z\n0,3,0\n10,6,0\n4,0,0\n10.25,20.25,3\n");
  if (run_touchmark({"query", "--scene", robot(R"(<sphere radius="1"/>)"), "--trajectory", motion,
                     "--detector", "brute-force"})
          .err.find("liburdfdom") != std::string::npos)
    GTEST_SKIP() << "built without liburdfdom";
  const Rows found = rows(robot(R"(<mesh filename="plate.off" scale="1 -1 2"/>)"), motion);
  EXPECT_EQ(found.bodies, (std::vector<std::string>{"base", "elbow", "elbow#2", "hand"}));
  const std::vector<double> distances{2, 1, 1, 3};
  for (std::size_t i = 0; i < distances.size(); ++i)
    EXPECT_NEAR(std::stod(found.distances.at(i)), distances[i], 2e-3) << i;
  const auto refuses = [&](const std::string& scene, const std::vector<std::string>& named) {
    expect_bad_input({"query", "--scene", scene, "--trajectory", motion, "--detector", "brute-force"}, named);
  };
  refuses(robot(R"(<mesh filename="package://arm/hand.stl"/>)"),
          {"arm.urdf", "\"hand\"", "package://arm/hand.stl"});
  refuses(robot(R"(<mesh filename="none.off"/>)"), {"arm.urdf", "\"hand\"", "none.off"});
  refuses(robot(R"(<box size="1 0 1"/>)"), {"arm.urdf", "\"hand\"", "box", "0"});
  refuses(robot(R"(<mesh filename="plate.off" scale="1 0 1"/>)"), {"\"hand\"", "scale"});
  refuses(write("none.urdf", "<robot name='r'><link name='a'/></robot>"), {"none.urdf", "geometry"});
  refuses(write("half.urdf", "<robot name='r'><link name="), {"half.urdf", "no URDF"});
  refuses(write("empty.urdf", ""), {"empty.urdf"});
}

// A plate in the plane z = 0 that faces +z does so, too, where x is mirrored.
TEST_F(SceneCommand, KeepsTheSideThatAMirroredMeshOfARobotFaces) {
  const auto normal_z = [&](const std::string& scale, const std::string& x) {
    const std::string robot = write("mirrored.urdf", R"(<robot name="r"><link name="l"><visual><geometry>)"
                                                     R"(<mesh filename="plate.off" scale=")" +
                                                         scale + R"("/></geometry></visual></link></robot>)");
    const std::string csv = (folder_ / "normals.csv").string();
    const Outcome outcome = run_touchmark({"query", "--scene", robot, "--trajectory",
                                           write("on.csv", "x,y,z\n" + x + ",0.25,0\n"), "--detector",
                                           "sphere-cluster", "--radius", "0.5", "--csv", csv});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return fields_in(csv, {"normal_z"}).at(0).at(0);
  };
  EXPECT_EQ(normal_z("1 1 1", "0.25"), "1");
  EXPECT_EQ(normal_z("-1 1 1", "-0.25"), "1");
  EXPECT_EQ(normal_z("-1 1 -1", "-0.25"), "-1");
}

TEST_F(SceneCommand, FindsThePackagesOfARobotWhereRosDoesAndWhereTheOptionSays) {
  const std::string robot = write("packaged.urdf", R"(<robot name="r"><link name="l"><visual><geometry>)"
                                                   R"(<mesh filename="package://arm/meshes/plate.off"/>)"
                                                   R"(</geometry></visual></link></robot>)");
  const std::string motion = write("above.csv", "x,y,z\n0.25,0.25,3\n");
  for (const char* const place : {"deep/in/source", "prefix/share/arm", "given"}) {
    fs::create_directories(folder_ / place / "meshes");
    fs::copy(folder_ / "plate.off", folder_ / place / "meshes/plate.off");
  }
  write("deep/in/source/package.xml", "<package><name> arm </name></package>");
  expect_bad_input({"query", "--scene", robot, "--trajectory", motion, "--detector", "brute-force"},
                   {"\"l\"", "\"arm\"", "ROS_PACKAGE_PATH", "--package arm=DIR"});
  expect_bad_input(
      {"query", "--scene", robot, "--package", "arm", "--trajectory", motion, "--detector", "brute-force"},
      {"--package arm", "NAME=DIR"});
  const std::vector<std::string> three{"3"};
  EXPECT_EQ(rows(robot, motion, {"--package", "arm=" + (folder_ / "given").string()}).distances, three);
  for (const auto& [variable, path] :
       {std::pair("ROS_PACKAGE_PATH", "/nowhere:" + (folder_ / "deep").string()),
        std::pair("AMENT_PREFIX_PATH", (folder_ / "prefix").string())}) {
    ::setenv(variable, path.c_str(), 1);
    EXPECT_EQ(rows(robot, motion).distances, three) << variable;
    ::unsetenv(variable);
  }
}

TEST_F(SceneCommand, VerifiesAPlainLoopOverMovingBodies) {
  const Outcome outcome = run_touchmark({"verify", "--scene", "heap:20:motion=all", "--detector", "looped",
                                         "--trajectory", "jump", "--trajectory", "slide", "--steps", "40"});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("240 answers judged exactly"), std::string::npos) << outcome.out;
}

// Ours, the plain ways and the rivals that are built in: each keeps what it claims, sweeps included.
TEST_F(SceneCommand, VerifiesAllWhoTakeScenes) {
  const Outcome outcome = run_touchmark({"verify", "--scene", "heap:20:motion=all", "--trajectory", "jump",
                                         "--trajectory", "slide", "--steps", "40", "--radius", "1%"});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const Outcome list = run_touchmark({"list"});
  for (const std::string rival : {"fcl", "bullet", "embree"}) {
    if (list.out.find("\n  " + rival + "  (not built)") != std::string::npos) continue;
    EXPECT_NE(outcome.out.find("\n" + rival), std::string::npos) << rival;
  }
}

TEST_F(SceneCommand, WritesRowsOfAComparison) {
  const std::string out = (folder_ / "out").string();
  const Outcome outcome =
      run_touchmark({"bench", "--scene", "assembly:27", "--quick", "--no-cold", "--steps", "200",
                     "--trajectory", "slide", "--detector", "looped", "--detector", "merged", "--out", out});
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const std::vector<Fields> rows = fields_in(out + "/results.csv", {"mesh", "triangles", "status"});
  EXPECT_EQ(rows, std::vector<Fields>(2, {"assembly:27", "324", "ok"}));
  const Outcome valid = run_touchmark({"validate", out});
  EXPECT_EQ(valid.status, 0) << valid.out << valid.err;
}

TEST_F(SceneCommand, AMovingQuerySeesABodyThatPassesBetweenTwoSteps) {
  const std::string where = scene(plate("sheet", "[0,0,-3]"));
  const std::string poses = write("poses.csv",
                                  "time_s,body,x,y,z,qw,qx,qy,qz\n0,sheet,0,0,-3,1,0,0,0\n"
                                  "1,sheet,0,0,4,1,0,0,0\n");
  const std::string motion = write("rest.csv", "time_s,x,y,z\n0,0.2,0.2,0\n1,0.2,0.2,0\n");
  const std::string csv = write("moving.csv", "");
  const std::vector<std::string> selectors{"--scene",      where,  "--poses",    poses,
                                           "--trajectory", motion, "--query",    "moving",
                                           "--radius",     "0.5",  "--detector", "sphere-cluster"};
  std::vector<std::string> query{"query"};
  query.insert(query.end(), selectors.begin(), selectors.end());
  query.insert(query.end(), {"--csv", csv});
  const Outcome outcome = run_touchmark(query);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::vector<Fields> rows = fields_in(csv, {"touching", "fraction", "body"});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0][0], "0");
  EXPECT_EQ(rows[1][0], "1");
  EXPECT_NEAR(std::stod(rows[1][1]), (3 - 0.5) / 7, 1e-9);
  EXPECT_EQ(rows[1][2], "sheet");
  std::vector<std::string> verify{"verify"};
  verify.insert(verify.end(), selectors.begin(), selectors.end());
  EXPECT_EQ(run_touchmark(verify).status, 0);
}

TEST_F(SceneCommand, AMovingQueryRefusesAMeshAndATurnThatIsTooFar) {
  const Outcome mesh =
      run_touchmark({"query", "--mesh", "torus:8x8", "--query", "moving", "--detector", "sphere-cluster"});
  EXPECT_EQ(mesh.status, 2);
  EXPECT_NE(mesh.err.find("there is no --scene"), std::string::npos) << mesh.err;
  const std::string poses = write("poses.csv",
                                  "time_s,body,x,y,z,qw,qx,qy,qz\n0,sheet,0,0,0,1,0,0,0\n"
                                  "1,sheet,0,0,0,0,0,0,1\n");
  const std::string motion = write("rest.csv", "time_s,x,y,z\n0,0.2,0.2,0\n1,0.2,0.2,0\n");
  const Outcome turn =
      run_touchmark({"query", "--scene", scene(plate("sheet", "[0,0,0]")), "--poses", poses, "--trajectory",
                     motion, "--query", "moving", "--detector", "sphere-cluster"});
  EXPECT_EQ(turn.status, 2);
  EXPECT_NE(turn.err.find("in a tick, which is more than 2"), std::string::npos) << turn.err;
}

TEST_F(SceneCommand, MovingQueriesAreRightWhereAllBodiesMove) {
  for (const std::string scene : {"heap:40:motion=all", "heap:40:motion=fall"}) {
    const Outcome outcome =
        run_touchmark({"verify", "--scene", scene, "--trajectory", "slide", "--query", "moving", "--steps",
                       "100", "--detector", "sphere-cluster", "--detector", "brute-force"});
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  }
}

/// Bodies far larger than the probe: what a sweep takes for their rounding counts beside its own bound.
TEST_F(SceneCommand, VerifyFindsNoSweepThatStopsTooEarlyInAHeapOfMovingBodies) {
  const Outcome outcome =
      run_touchmark({"verify", "--scene", "heap:200:motion=all", "--trajectory", "slide", "--query", "sweep",
                     "--steps", "300", "--detector", "sphere-cluster"});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
}

}  // namespace
}  // namespace touchmark::bench::cli
