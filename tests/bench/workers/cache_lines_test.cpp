/// What valgrind leaves is read as it is meant, and a detector whose lines can be told beforehand has them.
#include "bench/workers/timing/cache_lines.h"

#include <cstdlib>
#include <fstream>
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include "bench/support/failures.h"
#include "tests/bench/cli/run_touchmark.h"
#include "tests/temporary_folder.h"

namespace touchmark::bench::workers {
namespace {

TEST(CacheLines, AreMeansOfTheSamplesFirstMisses) {
  const CountsFolder folder;
  std::ofstream(folder.counts().string() + ".1") << "# callgrind format\nevents: Ir Dr Dw I1mr D1mr D1mw "
                                                    "ILmr DLmr DLmw\nfn=(1) replay\n12 3 0 0 0 0 0 0 0 0\n"
                                                    "totals: 9000 800 700 60 50 40 1 2 3\n";
  const CacheLines lines = counted_lines(folder.counts(), 10);
  EXPECT_EQ(lines.code, 6);
  EXPECT_EQ(lines.data, 9) << "read or written";
}

TEST(CacheLines, WithoutCountsAreAnErrorThatNamesTheFile) {
  const CountsFolder folder;
  EXPECT_THROW(counted_lines(folder.counts(), 10), support::ResourceError);
  std::ofstream(folder.counts().string() + ".1") << "events: Ir\ntotals: 9000\n";
  try {
    counted_lines(folder.counts(), 10);
    FAIL() << "no cache was simulated";
  } catch (const support::ResourceError& error) {
    EXPECT_NE(std::string(error.what()).find(folder.counts().string()), std::string::npos);
  }
}

TEST(CacheLines, OfBruteForceAreThoseOfAllTriangles) {
  const TemporaryFolder folder;
  const cli::Outcome finished =
      cli::run_touchmark({"bench", "--mesh", "icosphere:2", "--quick", "--no-cold", "--steps", "200",
                          "--trajectory", "jump", "--detector", "brute-force", "--cache-lines", "--out",
                          folder.file("out"), "--benchmark_repetitions=2"});
  ASSERT_EQ(finished.status, 0) << finished.err;
  std::smatch found;
  ASSERT_TRUE(std::regex_search(finished.out, found, std::regex("\nbrute-force +([0-9.]+) +([0-9.]+)\n")))
      << finished.out;
  // 320 triangles of 104 bytes lie in 520 lines or 521; besides, some of the session, the stack and the
  // replay.
  EXPECT_GE(std::stod(found[1]), 520);
  EXPECT_LT(std::stod(found[1]), 600);
  EXPECT_GT(std::stod(found[2]), 5);
  EXPECT_LT(std::stod(found[2]), 200);
}

TEST(CacheLines, WithoutValgrindAreRefusedInOneLine) {
  const char* const path = std::getenv("PATH");
  const std::string before = path != nullptr ? path : "";
  setenv("PATH", "/nowhere", 1);
  const cli::Outcome refused =
      cli::run_touchmark({"bench", "--mesh", "icosphere:1", "--quick", "--no-cold", "--cache-lines"});
  setenv("PATH", before.c_str(), 1);
  EXPECT_EQ(refused.status, 3);
  EXPECT_EQ(refused.err, "touchmark: valgrind is missing, which counts cache lines: scripts/setup develop\n");
}

}  // namespace
}  // namespace touchmark::bench::workers
