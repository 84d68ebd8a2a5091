#include "bench/trajectories/trajectory_csv.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "bench/trajectories/trajectories.h"

namespace touchmark::bench::trajectories {
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
  Trajectory read(const std::string& text, const MotionOptions& options = {}) const {
    return read_trajectory(file(text), 0, options);
  }

  /// The message without the directory.
  std::string complaint(const std::string& text, const MotionOptions& options = {}) const {
    try {
      read(text, options);
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
  const std::string must_name = "it must name x, y and z, or --columns say which they are";
  EXPECT_EQ(complaint("x,y\n1,2\n"), "path.csv:1: the header 'x,y' has no column z: " + must_name);
  const std::string no_names =
      "the first row '1,2,3' has numbers, and no line above it names x, y, z: --columns x=COL,y=COL,z=COL "
      "takes columns by number";
  EXPECT_EQ(complaint("1,2,3\n"), "path.csv:1: " + no_names);
  EXPECT_EQ(complaint("# made by hand\n\n1,2,3\n"), "path.csv:3: " + no_names);
  const std::string by_number = " (--columns x=COL,y=COL,z=COL[,time=COL] takes columns by number)";
  EXPECT_EQ(complaint("X,X,Y,Z\n1,2,3,4\n"),
            "path.csv:1: the header names column x twice: 'X' is column 1, 'X' is column 2" + by_number);
  EXPECT_EQ(complaint("x,y,z,y\n1,2,3,4\n"),
            "path.csv:1: the header names column y twice: 'y' is column 2, 'y' is column 4" + by_number);
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
            "path.csv:3: column time_s: '0.5' is not after the row before (--columns without time does not "
            "read times)");
  EXPECT_EQ(
      complaint("x,y,z,T\n1,2,3,1\n1,2,3,1\n"),
      "path.csv:3: column T: '1' is not after the row before (--columns without time does not read times)");
  EXPECT_EQ(complaint("x,y,z\n1,2\n"), "path.csv:2: the row has 2 fields, the header 3");
  EXPECT_EQ(complaint("x,y,z\n1,2,3,4\n"), "path.csv:2: the row has 4 fields, the header 3");
  EXPECT_EQ(complaint("x,y,z\n1,2,\"3\n"), "path.csv:2: a quote is never closed");
  EXPECT_EQ(complaint("x,y,z\n1,2,\"3\"4\n"), "path.csv:2: text follows a closing quote");
  EXPECT_EQ(complaint("x,y,z\n1,2," + std::string(1 << 17, '3') + "\n"),
            "path.csv:2: a field is longer than 64 KiB");
}

TEST_F(TrajectoryCsv, SemicolonsAndTabsSeparateToo) {
  for (const char* text : {
           "x;y;z\n1;2;3\n-4;0.5;6\n",
           "x;y;z\n1;2;3\n-4;0,5;6,0\n",  // decimal commas
           "x\ty\tz\n1\t2\t3\n-4\t5e-1\t6\n",
           "x\ty\tz\n1\t2\t3\n-4\t0,5\t6\n",
           "\"x\";\"y\";\"z\"\r\n\"1,0\";2;3\r\n-4;0,5;6\r\n",
           "sep=;\r\nx;y;z\r\n1;2;3\r\n-4;0,5;6\r\n",  // Excel
           "sep=|\nx|y|z\n1|2|3\n-4|0,5|6\n",
           "\xef\xbb\xbfx;y;z;;\r\n1;2;3;;\r\n-4;0,5;6;;\r\n;;;;\r\n",  // empty columns and rows
           "x,y,z\n1,2,3,\n-4,.5,6,,\n",
           "x,y,z,\"a;b;c;d\"\n1,2,3,4\n-4,.5,6,7\n",
       }) {
    EXPECT_EQ(read(text).positions, two) << text;
  }
}

TEST_F(TrajectoryCsv, RefusesMixedOrMisplacedDecimalMarks) {
  EXPECT_EQ(complaint("x;y;z\n1.5;2;3\n1;2,5;3\n"),
            "path.csv:3: column y: '2,5' has a decimal comma, numbers above a decimal point");
  EXPECT_EQ(complaint("x;y;z\n1,5;2;3\n1;2.5;3\n"),
            "path.csv:3: column y: '2.5' has a decimal point, numbers above a decimal comma");
  EXPECT_EQ(complaint("x;y;z\n1;1.234,5;3\n"), "path.csv:2: column y: '1.234,5' is not a number");
  EXPECT_EQ(complaint("x,y,z\n1,\"0,5\",3\n"),
            "path.csv:2: column y: '0,5' is not a number (decimal commas need ; or tabs between columns)");
  EXPECT_EQ(complaint("x,y,z\n0,5,1,5,2,5\n"), "path.csv:2: the row has 6 fields, the header 3");
}

TEST_F(TrajectoryCsv, SkipsCommentsAndReadsTheHeaderThatNumpyWrites) {
  for (const char* text : {
           "# recorded\n% by hand\n// today\nx,y,z\n# first\n1,2,3\n  # second\n-4,.5,6\n# end",
           "# recorded\n# x,y,z\n1,2,3\n-4,.5,6\n",
           "#X;Y;Z\r\n1;2;3\r\n-4;0,5;6\r\n",
           "%\"pos.x\",\"pos.y\",\"pos.z\"\n1,2,3\n-4,.5,6\n",
       }) {
    EXPECT_EQ(read(text).positions, two) << text;
  }
  const std::string long_comment(200'000, '#');
  EXPECT_EQ(read(long_comment + "\nx;y;z\n1;2;3\n" + long_comment + "\n-4;.5;6\n").positions, two);
}

TEST_F(TrajectoryCsv, KnowsTheNamesOfPositions) {
  for (const char* header : {"X,Y,Z", "px,py,pz", "PX,PY,PZ", "posX,posY,posZ", "pos_x,pos_y,pos_z",
                             "Pos x,Pos y,Pos z", "position.x,position.y,position.z", "hip-x,hip-y,hip-z"}) {
    EXPECT_EQ(read(std::string(header) + "\n1,2,3\n-4,.5,6\n").positions, two) << header;
  }
  // Those first in the list, and as they are written.
  EXPECT_EQ(read("px,py,pz,x,y,z,X\n9,9,9,1,2,3,9\n9,9,9,-4,.5,6,9\n").positions, two);
}

TEST_F(TrajectoryCsv, TimesMayBeInMilliseconds) {
  EXPECT_EQ(read("Time,x,y,z\n0.5,1,2,3\n1,-4,.5,6\n").times_s, (std::vector<double>{0.5, 1}));
  EXPECT_EQ(read("t_ms,x,y,z\n500,1,2,3\n1000,-4,.5,6\n").times_s, (std::vector<double>{0.5, 1}));
}

TEST_F(TrajectoryCsv, TimesMayStateTheirUnitInBrackets) {
  for (const char* name :
       {"time [ms]", "t (msec)", "Time (Milliseconds)", "timestamp [millis]", "time_ms [ms]"})
    EXPECT_EQ(read(std::string(name) + ",x,y,z\n500,1,2,3\n1000,-4,.5,6\n").times_s,
              (std::vector<double>{0.5, 1}))
        << name;
  for (const char* name :
       {"time [us]", "time (\u00b5s)", "time [\u03bcs]", "t [usec]", "time (Microseconds)"})
    EXPECT_EQ(read(std::string(name) + ",x,y,z\n500000,1,2,3\n1000000,-4,.5,6\n").times_s,
              (std::vector<double>{0.5, 1}))
        << name;
  for (const char* name : {"time [ns]", "t [nsec]", "timestamp (nanoseconds)"})
    EXPECT_EQ(read(std::string(name) + ",x,y,z\n500000000,1,2,3\n1000000000,-4,.5,6\n").times_s,
              (std::vector<double>{0.5, 1}))
        << name;
  for (const char* unit : {"min", "h", "frames", "ticks"}) {
    const std::string text = complaint(std::string("time [") + unit + "],x,y,z\n1,1,2,3\n2,-4,.5,6\n");
    EXPECT_TRUE(text.starts_with(std::string("path.csv:1: column 'time [") + unit + "]': the unit '" + unit +
                                 "' is none of s, ms, us and ns; --columns"))
        << text;
  }
  EXPECT_NE(complaint("time_ms [s],x,y,z\n1,1,2,3\n").find("the name states two units"), std::string::npos);
}

TEST_F(TrajectoryCsv, ARowOfSeparatorsAloneIsNoSampleAtTheEndAndRefusedBefore) {
  EXPECT_EQ(read("x,y,z\n1,2,3\n-4,.5,6\n,,\n,,\n\n").positions, two);
  EXPECT_EQ(read("x,y,z\n\n1,2,3\n\n-4,.5,6\n").positions, two);
  EXPECT_EQ(complaint("x,y,z\n,,\n1,2,3\n"), "path.csv:2: the row is empty, and rows follow it");
  EXPECT_EQ(complaint("x,y,z\n1,2,3\n,,\n-4,.5,6\n"), "path.csv:3: the row is empty, and rows follow it");
}

TEST_F(TrajectoryCsv, ColumnsAreChosenByNameOrNumber) {
  MotionOptions options;
  options.columns = parse_columns("x=3,y=height,z=1,time_ms=clock,radius=5");
  const Trajectory path = read("a,clock,b,Height,c\n3,0,1,2,0.25\n6,4,-4,.5,0.5\n", options);
  EXPECT_EQ(path.positions, two);
  EXPECT_EQ(path.times_s, (std::vector<double>{0, 0.004}));
  EXPECT_EQ(path.radii, (std::vector<double>{0.25, 0.5}));

  options.columns = parse_columns("x=2,y=3,z=4");
  for (const char* text :
       {"0;1;2;3\n0;-4;0,5;6\n", "a;b;c;d\n0;1;2;3\n0;-4;0,5;6\n", "time_s,x,y,z\n0,1,2,3\n0,-4,.5,6\n"}) {
    const Trajectory chosen = read(text, options);
    EXPECT_EQ(chosen.positions, two) << text;
    EXPECT_TRUE(chosen.times_s.empty()) << text;
  }
  EXPECT_EQ(complaint("a,b\n1,2\n", options), "path.csv:2: --columns: there is no column 3 of 2");
  options.columns = parse_columns("x=a,y=b,z=Q");
  EXPECT_EQ(complaint("a,b\n1,2\n", options), "path.csv:1: --columns: the header has no column 'Q'");
}

/// Three rows of a log, by the text before and after each position.
std::string log_of(const std::array<std::string, 3>& before, const std::string& after = "",
                   char separator = ',') {
  std::string text;
  for (std::size_t i = 0; i < 3; ++i) {
    text += before[i] + (before[i].empty() ? "" : std::string(1, separator));
    text += fmt::format("0{0}0{0}{1}{2}\n", separator, std::array{"0.05", "0.04", "0.03"}[i], after);
  }
  return text;
}
const std::vector<Vec3> three = {{0, 0, 0.05}, {0, 0, 0.04}, {0, 0, 0.03}};
const std::vector<double> milliseconds = {0, 0.001, 0.002};
const std::array<std::string, 3> epoch_ns = {"1600000000000000000", "1600000000001000000",
                                             "1600000000002000000"};

TEST_F(TrajectoryCsv, NoRowOfNumbersIsLostAsAHeader) {
  const MotionOptions options = parse_motion_options("x=1,y=2,z=3", "", "");
  EXPECT_EQ(read(log_of({}, ",idle"), options).positions, three);
  EXPECT_EQ(read(log_of({}, ",true"), options).positions, three);
  EXPECT_EQ(read("here,there,above,state\n" + log_of({}, ",idle"), options).positions, three);
  EXPECT_EQ(read("3D_x,3D_y,3D_z\n" + log_of({}), options).positions, three);
  for (const char* field : {"NA", "", "-", "two", "0x1"}) {
    EXPECT_EQ(complaint(std::string(field) + ",0,0\n" + log_of({}), options),
              "path.csv:1: column 1: '" + std::string(field) + "' is not a number");
  }
  for (const char* field : {"nan", "NaN", "-inf"}) {
    EXPECT_EQ(complaint(std::string(field) + ",0,0\n" + log_of({}), options),
              "path.csv:1: column 1: '" + std::string(field) + "' is not finite");
  }
  EXPECT_EQ(complaint("0,0\n" + log_of({}), options), "path.csv:1: --columns: there is no column 3 of 2");
  EXPECT_EQ(complaint("0,0,1\nx,y,z\n" + log_of({})),
            "path.csv:1: the row '0,0,1' has numbers, and stands above the header");
}

TEST_F(TrajectoryCsv, NamesInACommentMayStandAboveRowsWithWords) {
  const std::string text =
      "# idle or down\n# t,x,y,z,state\n# by hand\n" + log_of({"0", "0.001", "0.002"}, ",idle");
  for (const char* columns : {"", "x=2,y=3,z=4,time=1", "x=x,y=3,z=z,time_s=t"}) {
    const Trajectory path = read(text, parse_motion_options(columns, "", ""));
    EXPECT_EQ(path.positions, three) << columns;
    EXPECT_EQ(path.times_s, milliseconds) << columns;
  }
  EXPECT_EQ(complaint("# t x y z x\n" + log_of({"0", "1", "2"}, ",9")),
            "path.csv:1: the header names column x twice: 'x' is column 2, 'x' is column 5 (--columns "
            "x=COL,y=COL,z=COL[,time=COL] takes columns by number)");
}

TEST_F(TrajectoryCsv, ReadsLogsOfRos1) {
  const std::string position =
      "field.pose.pose.position.x,field.pose.pose.position.y,field.pose.pose.position.z";
  for (const std::string& names :
       {position, std::string("field.point.x,field.point.y,field.point.z"),
        std::string(
            "field.transform.translation.x,field.transform.translation.y,field.transform.translation.z")}) {
    const std::string text =
        "%time,field.header.seq,field.header.frame_id," + names + ",field.twist.linear.x\n" +
        log_of({epoch_ns[0] + ",7,tool", epoch_ns[1] + ",8,tool", epoch_ns[2] + ",9,"}, ",5");
    for (const char* columns : {"", "x=4,y=5,z=6,time=1", "x=x,y=y,z=z,time_ns=time"}) {
      const Trajectory path = read(text, parse_motion_options(columns, "", ""));
      EXPECT_EQ(path.positions, three) << columns;
      EXPECT_EQ(path.times_s, milliseconds) << columns;
    }
  }
}

TEST_F(TrajectoryCsv, ReadsLogsOfRos2InSecondsAndNanoseconds) {
  const std::string text =
      log_of({"1600000000,0,tool", "1600000000,1000000,tool", "1600000000,2000000,tool"});
  for (const char* columns :
       {"time_s=1,time_ns=2,x=4,y=5,z=6", "x=4,y=5,z=6,time_ns=2,time_s=1", "x=4,y=5,z=6"}) {
    const Trajectory path = read(text, parse_motion_options(columns, "", ""));
    EXPECT_EQ(path.positions, three) << columns;
    EXPECT_EQ(path.times_s, milliseconds) << columns;
  }
  EXPECT_EQ(
      read("header.stamp.sec,header.stamp.nanosec,frame,pose.position.x,pose.position.y,pose.position.z\n" +
           text)
          .times_s,
      milliseconds);
  // Times that nobody chose are left where they are none.
  const std::string repeated = log_of({"1600000000,0,t", "1600000000,0,t", "1600000000,0,t"});
  EXPECT_EQ(read(repeated, parse_motion_options("x=4,y=5,z=6", "", "")).positions, three);
  EXPECT_EQ(complaint(repeated, parse_motion_options("x=4,y=5,z=6", "", "1000")),
            "path.csv:2: column 1: '1600000000' and '0' in column 2 is not after the row before (--columns "
            "without time does not read times)");
  const MotionOptions chosen = parse_motion_options("time_s=1,time_ns=2,x=3,y=4,z=5", "", "");
  EXPECT_EQ(complaint("1,1000000000,0,0,0\n", chosen),
            "path.csv:1: columns 1 and 2: '1' and '1000000000' are not whole seconds and less than one");
  EXPECT_EQ(complaint("1.5,0,0,0,0\n", chosen),
            "path.csv:1: columns 1 and 2: '1.5' and '0' are not whole seconds and less than one");
}

TEST_F(TrajectoryCsv, ReadsTumEurocAndMotive) {
  const std::array<std::string, 3> seconds = {"1600000000.000", "1600000000.001", "1600000000.002"};
  const std::string tum = log_of(seconds, " 0 0 0 1", ' ');
  const std::string euroc =
      "#timestamp [ns],p_RS_R_x [m],p_RS_R_y [m],p_RS_R_z [m],q_RS_w [],v_RS_R_x [m s^-1]\r\n";
  const std::string motive =
      "Format Version,1.23,Take Name,2 hands,Capture Frame Rate,120.0,Length Units,Meters\n\n"
      ",,Rigid Body,Rigid Body,Rigid Body\n,,Tool,Tool,Tool\nFrame,Time (Seconds),X,Y,Z\n" +
      log_of({"0,0.000", "1,0.001", "2,0.002"});
  for (const auto& [text, columns] :
       {std::pair<std::string, std::string>{"# a\n# timestamp tx ty tz qx qy qz qw\n" + tum, ""},
        {tum, "x=2,y=3,z=4,time=1"},
        {"#,timestamp,tx,ty,tz,qx,qy,qz,qw\n" + log_of(seconds, ",0,0,0,1"), "x=tx,y=ty,z=tz,time=timestamp"},
        {euroc + log_of(epoch_ns, ",1,0"), ""},
        {euroc + log_of(epoch_ns, ",1,0"), "x=p_RS_R_x,y=p_RS_R_y,z=p_RS_R_z,time=timestamp"},
        {motive, ""},
        {motive, "x=3,y=4,z=5,time=2"}}) {
    const Trajectory path = read(text, parse_motion_options(columns, "", ""));
    EXPECT_EQ(path.positions, three) << text;
    EXPECT_EQ(path.times_s, milliseconds) << text;
  }
  // A tracker that has not yet found the body.
  EXPECT_EQ(
      complaint("Frame,Time,X,Y,Z\n0,0.000,,,\n1,0.001,0,0,0\n", parse_motion_options("x=3,y=4,z=5", "", "")),
      "path.csv:2: column 3: '' is not a number");
  EXPECT_EQ(complaint("pose.x,pose.y,pose.z,transform.x,transform.y,transform.z\n1,2,3,4,5,6\n"),
            "path.csv:1: the header names column x twice: 'pose.x' is column 1, 'transform.x' is column 4 "
            "(--columns x=COL,y=COL,z=COL[,time=COL] takes columns by number)");
}

TEST_F(TrajectoryCsv, TimesSince1970AreSubtractedExactly) {
  MotionOptions options;
  options.rate_hz = 2000;
  for (const char* text :
       {"time_ns,x,y,z\n1600000000999500000,0,0,1\n1600000001000000000,0,0,2\n",
        "time,x,y,z\n1600000000999500,0,0,1\n1600000001000000,0,0,2\n",
        "Time [ms];x;y;z\n1600000000999,5;0;0;1\n1600000001000;0;0;2\n",
        "time x y z\n1600000000.9995 0 0 1\n1.600000001e9 0 0 2\n",
        "stamp_sec,stamp_nanosec,x,y,z\n1600000000,999500000,0,0,1\n1600000001,0,0,0,2\n"}) {
    const Trajectory path = read(text, options);
    EXPECT_EQ(path.times_s, (std::vector<double>{0, 0.0005})) << text;
    EXPECT_EQ(path.positions.back(), Vec3(0, 0, 2)) << text;
  }
  // A scene's bodies move by the same clock.
  options.of_a_scene = true;
  EXPECT_EQ(read("t,x,y,z\n1600000000,0,0,1\n1600000001,0,0,2\n", options).times_s.front(), 1.6e9);
}

TEST_F(TrajectoryCsv, BlanksSeparateAndCarriageReturnsEndLines) {
  for (const char* text : {
           "x,y,z\r1,2,3\r-4,.5,6\r",
           "# x,y,z\r1,2,3\r\n\r-4,.5,6",
           "x y z\n1 2 3\n-4 .5 6\n",
           "  x\t y z \n 1   2\t3  \n-4 0,5 6\n",
           "# x y z\n1,2,3\n-4,.5,6\n",
           "x, \"y\" , z,\n\"1\", 2, 3\n \n-4,.5 ,6,\n",
           "x;y;z;list\n1;2;3;1,2,3,4\n-4;,5;6;1,2,3,4\n",
           "x,y,z,note\n1,2,3,a 1 2 3\n-4,.5,6,b 1 2 3\n",
       }) {
    EXPECT_EQ(read(text).positions, two) << text;
  }
  EXPECT_EQ(complaint("sep=\xff\nx,y,z\n1,2,3\n"), "path.csv: the first line names no separator");
  EXPECT_EQ(complaint("x,y,z\r1,2,3\r\r1,two,3\r"), "path.csv:4: column y: 'two' is not a number");
}

TEST_F(TrajectoryCsv, TheScaleIsOfCoordinatesAndRadii) {
  MotionOptions options;
  options.scale = 1000;
  const Trajectory path = read("x,y,z,radius,time_s\n0.001,0.002,0.003,0.5,1\n", options);
  EXPECT_EQ(path.positions[0], Vec3(0.001 * 1000, 0.002 * 1000, 0.003 * 1000));
  EXPECT_EQ(path.radii[0], 500);
  EXPECT_EQ(path.times_s[0], 1);
  options.scale = 1e300;
  EXPECT_EQ(complaint("x,y,z\n0,1e10,0\n", options),
            "path.csv:2: column y: '1e10' times --motion-scale is beyond the range of a double");
}

TEST_F(TrajectoryCsv, RowsWithTimesAreStepsWhereTheyAreEvenlySpaced) {
  const Trajectory path = read("time_s,x,y,z\n10,0,0,0\n10.001,1,0,0\n10.0024,2,0,0\n10.003,3,0,0\n");
  EXPECT_EQ(path.size(), 4u);
  ASSERT_TRUE(path.recorded);
  EXPECT_EQ(path.recorded->rows, 4u);
  EXPECT_NEAR(path.recorded->duration_s, 0.003, 1e-14);
  EXPECT_NEAR(*path.recorded->rate_hz(), 1000, 1e-8);
  EXPECT_FALSE(path.recorded->resampled_hz);
  EXPECT_FALSE(read("x,y,z\n1,2,3\n").recorded);
  EXPECT_EQ(complaint("time_s,x,y,z\n0,0,0,0\n# lost one\n0.001,1,0,0\n0.003,2,0,0\n0.004,3,0,0\n"),
            "path.csv:5: column time_s: 0.002 s after the row before, longer than the usual interval: rows "
            "are not evenly spaced; --rate HZ resamples them");
}

TEST_F(TrajectoryCsv, ResamplesByTimeAlongStraightLines) {
  MotionOptions options;
  options.rate_hz = 1000;
  const Trajectory path =
      read("time_s,x,y,z,radius\n7,0,0,0,1\n7.002,2,0,-4,3\n7.003,3,1,-4,3\n7.0055,3,6,-4,3\n", options);
  // At 0, 1, 2, 3, 4 and 5 ms; what comes after the last tick is left.
  const std::vector<Vec3> expected = {{0, 0, 0}, {1, 0, -2}, {2, 0, -4}, {3, 1, -4}, {3, 3, -4}, {3, 5, -4}};
  ASSERT_EQ(path.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_LT((path.positions[i] - expected[i]).norm(), 1e-9) << i;  // times near 7 are off by 1e-15
  EXPECT_NEAR(path.radii[1], 2, 1e-9);
  EXPECT_EQ(path.recorded->rows, 4u);
  EXPECT_EQ(path.recorded->resampled_hz, 1000);
  EXPECT_EQ(complaint("x,y,z\n1,2,3\n", options),
            "path.csv:1: --rate needs times, and the header has no column time_s (or --columns name none)");
  EXPECT_EQ(complaint("t,x,y,z\n0,0,0,0\n1e9,1,2,3\n", options),
            "path.csv: 1000000000 s at --rate 1000 are 1000000000001 steps, more than 100000000");
}

// Decimal times are not those of a clock; at the clock's own rate just the rows come out nevertheless.
TEST_F(TrajectoryCsv, AtItsOwnRateAMotionKeepsItsRows) {
  for (const double start : {0.0, 0.1, 1.7e9}) {
    std::string text = "time_s,x,y,z\n";
    std::vector<Vec3> rows;
    for (int i = 0; i < 3000; ++i) {
      std::ostringstream row;
      row.precision(15);
      row << start + i / 1000.0 << ',' << 0.1 * i << ",0.3,-0.7\n";
      text += row.str();
      rows.emplace_back(0.1 * i, 0.3, -0.7);
    }
    MotionOptions options;
    options.rate_hz = 1000;
    const Trajectory path = read(text, options);
    ASSERT_EQ(path.size(), rows.size()) << start;
    for (std::size_t i = 0; i < rows.size(); ++i) ASSERT_LT((path.positions[i] - rows[i]).norm(), 1e-9) << i;
    // The first steps are the same ones, wherever reading stops.
    const Trajectory few = read_trajectory(file(text), 100, options);
    ASSERT_EQ(few.size(), 100u);
    for (std::size_t i = 0; i < few.size(); ++i) ASSERT_EQ(few.positions[i], path.positions[i]) << i;
  }
}

TEST_F(TrajectoryCsv, OptionsAreRefusedByNameAndValue) {
  const auto refusal = [](const std::string& columns, const std::string& scale, const std::string& rate) {
    try {
      parse_motion_options(columns, scale, rate);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const std::string form = "; write x=COL,y=COL,z=COL[,time=COL][,radius=COL], COL a name or a number from 1";
  EXPECT_EQ(refusal("x=1,y=2", "", ""), "--columns \"x=1,y=2\": z is missing" + form);
  EXPECT_EQ(refusal("x=1,y=2,z=0", "", ""), "--columns \"x=1,y=2,z=0\": columns are counted from 1" + form);
  EXPECT_EQ(refusal("x=1,x=2,z=3", "", ""), "--columns \"x=1,x=2,z=3\": \"x=2\" is one x too many" + form);
  EXPECT_EQ(refusal("x=,y=2,z=3", "", ""), "--columns \"x=,y=2,z=3\": a column is empty" + form);
  EXPECT_EQ(refusal("1,2,3", "", ""), "--columns \"1,2,3\": \"1\" is not KEY=COL with a known key" + form);
  for (const char* bad : {"0", "-1", "inf", "nan", "1e-320", "fast"}) {
    EXPECT_EQ(refusal("", bad, ""),
              "--motion-scale \"" + std::string(bad) + "\" is not a finite number above 0");
    EXPECT_EQ(refusal("", "", bad), "--rate \"" + std::string(bad) + "\" is not a finite number above 0");
  }
}

TEST_F(TrajectoryCsv, RefusesUtf16AndPipesThatNobodyWritesTo) {
  EXPECT_EQ(complaint(std::string("\xff\xfex\0,\0", 6)),
            "path.csv: is UTF-16 text: save it as UTF-8 (\"CSV UTF-8\" in spreadsheets)");
  const std::string pipe = directory_ / "pipe.csv";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  try {
    read_trajectory(pipe);
    ADD_FAILURE() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(error.what(), pipe + ": is a pipe that nobody writes to");
  }
  std::thread writer([&] { std::ofstream(pipe) << "x,y,z\n1,2,3\n-4,.5,6\n"; });
  EXPECT_EQ(read_trajectory(pipe).positions, two);
  writer.join();
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

TEST_F(TrajectoryCsv, IsATrajectoryLikeAnyOther) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const std::string path = file("x,y,z\n1,2,3\n-4,5e-1,6\n");
  EXPECT_EQ(make_trajectory(path, mesh).positions, two);
  EXPECT_EQ(make_trajectory(path, mesh, {1, 1, 0}).size(), 1u);
  EXPECT_THROW(make_trajectory("missing.csv", mesh), std::invalid_argument);
}

}  // namespace
}  // namespace touchmark::bench::trajectories
