// Scenes of bodies as a user meets them: files, motions, rows and errors.
#include <filesystem>
#include <fstream>
#include <string>
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

TEST_F(SceneCommand, RefusesShapesAndSizesThatAreNoneInOneLine) {
  const std::string motion = write("motion.csv", "x,y,z\n0,0,0\n");
  const auto refuses = [&](const std::string& members, const std::vector<std::string>& named) {
    expect_bad_input({"query", "--scene",
                      scene(R"({"name":"a","position":[0,0,0],"orientation":[1,0,0,0],)" + members + "}"),
                      "--trajectory", motion, "--detector", "brute-force"},
                     named);
  };
  refuses(R"("shape":"cone","size":[1,1,1])", {"\"a\"", "cone", "plane, box"});
  refuses(R"("shape":"box","size":[1,1])", {"\"a\"", "size", "2", "3"});
  refuses(R"("shape":"box","size":[1,-1,1])", {"\"a\"", "size", "number 2", "-1"});
  refuses(R"("shape":"box","size":[1,0,1])", {"size", "number 2"});
  refuses(R"("shape":"box","size":[1,1e300,1])", {"size", "number 2", "1e+30"});
  refuses(R"("shape":"box","size":4)", {"size", "list"});
  refuses(R"("shape":"box")", {"size", "missing"});
  refuses(R"("shape":"box","size":[1,1,1],"mesh":"cube")", {"mesh", "shape"});
  refuses(R"("shape":7)", {"shape", "text"});
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
  for (const std::string command : {"choose", "stress", "scale", "update"})
    expect_bad_input({command, "--scene", "heap:3"},
                     {command, "--scene", "query, verify, bench, servo and gate"});
  expect_bad_input({"choose", "--poses", "poses.csv"}, {"choose", "--poses"});
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

// A tree of nodes: the child is where its parent takes it. A node that scales is no rigid body.
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
  expect_bad_input({"query", "--scene", write("scaled.gltf", gltf(R"("scale":[2,2,2])")), "--trajectory",
                    motion, "--detector", "brute-force"},
                   {"scaled.gltf", "tip", "scales"});
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

}  // namespace
}  // namespace touchmark::bench::cli
