#include "bench/trajectory_csv.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include <gtest/gtest.h>
#include <unistd.h>

#include "bench/trajectories.h"

namespace touchmark::bench {
namespace {

/// A directory of its own for each test, removed at its end.
class TrajectoryCsv : public testing::Test {
 protected:
  TrajectoryCsv()
      : directory_(std::filesystem::temp_directory_path() /
                   (std::string("touchmark_") +
                    testing::UnitTest::GetInstance()->current_test_info()->name() +
                    std::to_string(::getpid()))) {
    std::filesystem::create_directories(directory_);
  }
  ~TrajectoryCsv() override { std::filesystem::remove_all(directory_); }

  std::string file(const std::string& text, const std::string& name = "path.csv") const {
    const std::string path = directory_ / name;
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  Trajectory read(const std::string& text) const { return read_trajectory(file(text)); }

  /// The message without the directory.
  std::string complaint(const std::string& text) const {
    try {
      read(text);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what()).substr(directory_.string().size() + 1);
    }
    return "accepted";
  }

  std::filesystem::path directory_;
};

const std::vector<Vec3> two = {{1, 2, 3}, {-4, 5e-1, 6}};

TEST_F(TrajectoryCsv, ReadsThePlainForm) {
  const Trajectory path = read("x,y,z\n1,2,3\n-4,5e-1,6\n");
  EXPECT_EQ(path.positions, two);
  EXPECT_TRUE(path.radii.empty());
  EXPECT_TRUE(path.times_s.empty());
}

TEST_F(TrajectoryCsv, TakesColumnsInAnyOrderAndIgnoresOthers) {
  const Trajectory path =
      read("force,z,radius,y,note,time_s,x\n9,3,.5,2,hello,0,1\n9,6,0,.5,\"a,b\",0.25,-4\n");
  EXPECT_EQ(path.positions, two);
  EXPECT_EQ(path.radii, (std::vector<double>{0.5, 0}));
  EXPECT_EQ(path.times_s, (std::vector<double>{0, 0.25}));
}

TEST_F(TrajectoryCsv, AcceptsWhatSpreadsheetsWrite) {
  for (const char* text : {
           "x,y,z\r\n1,2,3\r\n-4,5e-1,6\r\n",                      // CRLF
           "x,y,z\n1,2,3\n-4,5e-1,6",                              // no newline at the end
           "x,y,z\r\n1,2,3\r\n-4,5e-1,6\r",                        // half a line end
           "\"x\",\"y\",\"z\"\r\n\"1\",2,3\r\n-4,5e-1,\"6\"\r\n",  // quotes
           "\xef\xbb\xbfx,y,z\n1,2,3\n-4,5e-1,6\n",                // byte order mark
           " x , y\t, z\n 1,\t2 , +3\n-4, 5e-1 , 6.000\n",         // spaces
           "\n\nx,y,z\n\n1,2,3\n\r\n-4,5e-1,6\n\n",                // empty lines
       }) {
    EXPECT_EQ(read(text).positions, two) << text;
  }
}

TEST_F(TrajectoryCsv, NamesTheLineAndColumnOfWhatIsWrong) {
  EXPECT_EQ(complaint(""), "path.csv: the file is empty: it needs a header that names x, y and z");
  EXPECT_EQ(complaint("\n\n"), "path.csv: the file is empty: it needs a header that names x, y and z");
  EXPECT_EQ(complaint("x,y\n1,2\n"), "path.csv:1: the header has no column z: it must name x, y and z");
  EXPECT_EQ(complaint("1,2,3\n"), "path.csv:1: the header has no column x: it must name x, y and z");
  EXPECT_EQ(complaint("x,y,z,y\n1,2,3,4\n"), "path.csv:1: the header names column y twice");
  EXPECT_EQ(complaint("x,y,z\n"), "path.csv:1: no row follows the header");
  EXPECT_EQ(complaint("x,y,z\n1,2,3\n1,two,3\n"), "path.csv:3: column y: 'two' is not a number");
  EXPECT_EQ(complaint("x,y,z\n1,\x1b[2J,3\n"), "path.csv:2: column y: '?[2J' is not a number");
  EXPECT_EQ(complaint("x,y,z\n1,2,\n"), "path.csv:2: column z: '' is not a number");
  EXPECT_EQ(complaint("x,y,z\n1,2,3 4\n"), "path.csv:2: column z: '3 4' is not a number");
  EXPECT_EQ(complaint("x,y,z\n0x1,2,3\n"), "path.csv:2: column x: '0x1' is not a number");
  EXPECT_EQ(complaint("x,y,z\n+-1,2,3\n"), "path.csv:2: column x: '+-1' is not a number");
  EXPECT_EQ(complaint("x,y,z\n1,nan,3\n"), "path.csv:2: column y: 'nan' is not finite");
  EXPECT_EQ(complaint("x,y,z\n1,2,-inf\n"), "path.csv:2: column z: '-inf' is not finite");
  EXPECT_EQ(complaint("x,y,z\n1,2,1e999\n"), "path.csv:2: column z: '1e999' is beyond the range of a double");
  EXPECT_EQ(complaint("x,y,z,radius\n1,2,3,-0.5\n"), "path.csv:2: column radius: '-0.5' is negative");
  EXPECT_EQ(complaint("x,y,z,radius\n1,2,3,inf\n"), "path.csv:2: column radius: 'inf' is not finite");
  EXPECT_EQ(complaint("x,y,z,time_s\n1,2,3,1\n1,2,3,0.5\n"),
            "path.csv:3: column time_s: '0.5' is before the row above");
  EXPECT_EQ(complaint("x,y,z\n1,2\n"), "path.csv:2: the row has 2 fields, the header 3");
  EXPECT_EQ(complaint("x,y,z\n1,2,3,4\n"), "path.csv:2: the row has 4 fields, the header 3");
  EXPECT_EQ(complaint("x,y,z\n1,2,\"3\n"), "path.csv:2: a quote is never closed");
  EXPECT_EQ(complaint("x,y,z\n1,2,\"3\"4\n"), "path.csv:2: text follows a closing quote");
  EXPECT_EQ(complaint("x,y,z\n1,2," + std::string(1 << 17, '3') + "\n"),
            "path.csv:2: a field is longer than 64 KiB");
}

TEST_F(TrajectoryCsv, CountsLinesInsideQuotes) {
  EXPECT_EQ(complaint("x,y,z,note\n1,2,3,\"a\nb\"\n1,?,3,c\n"), "path.csv:4: column y: '?' is not a number");
}

TEST_F(TrajectoryCsv, RefusesWhatIsNoFile) {
  EXPECT_THROW(read_trajectory(directory_ / "missing.csv"), std::invalid_argument);
  EXPECT_THROW(read_trajectory(directory_), std::invalid_argument);
}

TEST_F(TrajectoryCsv, KeepsTheFirstRowsOfALongFile) {
  EXPECT_EQ(read_trajectory(file("x,y,z\n1,2,3\n-4,5e-1,6\n7,8,9\n"), 2).positions, two);
}

TEST_F(TrajectoryCsv, ReadsAFileOfManyBuffers) {
  std::string text = "x,y,z\n";
  for (int i = 0; i < 50'000; ++i) text += std::to_string(i) + "," + std::to_string(2 * i) + ",0.125\n";
  const Trajectory path = read(text);
  ASSERT_EQ(path.size(), 50'000u);
  for (int i = 0; i < 50'000; ++i)
    ASSERT_EQ(path.positions[static_cast<std::size_t>(i)], Vec3(i, 2 * i, 0.125));
}

TEST_F(TrajectoryCsv, WritesWhatReadsBackToTheSameBits) {
  const Trajectory written{"odd numbers",
                           {{0.1, -1.0 / 3, 5e-324}, {1e6 + 1e-10, 1.7976931348623157e308, -0.0}},
                           {0.005, 0},
                           {0, 0.001}};
  const std::string path = directory_ / "out.csv";
  write_trajectory(written, path);
  const Trajectory back = read_trajectory(path);
  EXPECT_EQ(back.positions, written.positions);
  EXPECT_TRUE(std::signbit(back.positions[1].z()));
  EXPECT_EQ(back.radii, written.radii);
  EXPECT_EQ(back.times_s, written.times_s);
}

TEST_F(TrajectoryCsv, WritesTheShortestText) {
  const std::string path = directory_ / "out.csv";
  write_trajectory({"short", {{0.1, 2, 1e22}}, {}, {}}, path);
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  EXPECT_EQ(text.str(), "x,y,z\n0.1,2,1e+22\n");
}

TEST_F(TrajectoryCsv, LeavesNothingBehindWhereItCannotWrite) {
  const std::string path = directory_ / "no such folder" / "out.csv";
  try {
    write_trajectory({"lost", two, {}, {}}, path);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), "cannot write " + path + ": No such file or directory");
  }
  std::filesystem::create_directory(directory_ / "taken.csv");
  EXPECT_THROW(write_trajectory({"lost", two, {}, {}}, directory_ / "taken.csv"), std::runtime_error);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory_), {}), 1);
}

TEST_F(TrajectoryCsv, WritesIntoDevicesWithoutReplacingThem) {
  write_trajectory({"gone", two, {}, {}}, "/dev/null");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(TrajectoryCsv, FailsOnAFullDisk) {
  Trajectory large{"large", std::vector<Vec3>(10'000, two[1]), {}, {}};
  EXPECT_THROW(write_trajectory(large, "/dev/full"), std::runtime_error);
}

TEST_F(TrajectoryCsv, IsATrajectoryLikeAnyOther) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const std::string path = file("x,y,z\n1,2,3\n-4,5e-1,6\n");
  EXPECT_EQ(make_trajectory(path, mesh).positions, two);
  EXPECT_EQ(make_trajectory(path, mesh, {1, 1, 0}).size(), 1u);
  EXPECT_THROW(make_trajectory("missing.csv", mesh), std::invalid_argument);
}

}  // namespace
}  // namespace touchmark::bench
