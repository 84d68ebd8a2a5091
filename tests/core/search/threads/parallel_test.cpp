#include "core/search/threads/parallel.h"

#include <atomic>
#include <cstddef>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace touchmark {
namespace {

TEST(Parallel, DoesEachPieceOnceWithAnyNumberOfThreads) {
  for (const std::size_t count : {0U, 1U, 2U, 1000U}) {
    for (const unsigned threads : {1U, 2U, 3U, max_threads}) {
      std::vector<int> done(count, 0);
      std::atomic<bool> numbered = true;
      in_parallel(count, threads, [&](unsigned thread, std::size_t piece) {
        ++done[piece];
        if (thread >= threads) numbered = false;
      });
      EXPECT_EQ(done, std::vector<int>(count, 1)) << threads;
      EXPECT_TRUE(numbered) << threads;
    }
  }
}

TEST(Parallel, RunsOnTheCallersThreadAlone) {
  const std::thread::id caller = std::this_thread::get_id();
  in_parallel(10, 1, [&](unsigned, std::size_t) { EXPECT_EQ(std::this_thread::get_id(), caller); });
}

TEST(Parallel, RunsPiecesAtTheSameTime) {
  // Each of two pieces waits for the other.
  std::atomic<int> begun = 0;
  in_parallel(2, 2, [&](unsigned, std::size_t) {
    ++begun;
    while (begun < 2) std::this_thread::yield();
  });
  EXPECT_EQ(begun, 2);
}

TEST(Parallel, HandsOnWhatTheLowestPieceThrew) {
  for (const unsigned threads : {1U, 2U, 3U}) {
    std::atomic<int> after = 0;
    try {
      in_parallel(10'000, threads, [&](unsigned, std::size_t piece) {
        if (piece == 7 || piece == 8) throw std::runtime_error("piece " + std::to_string(piece));
        if (piece > 8) ++after;
      });
      ADD_FAILURE() << "nothing was thrown by " << threads;
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "piece 7");
    }
    EXPECT_LT(after, 9'000) << "the rest was begun, too";
  }
}

TEST(Parallel, CutsRangesOfOneLengthButTheLast) {
  std::vector<std::pair<std::size_t, std::size_t>> ranges;
  in_ranges(10, 4, 1, [&](std::size_t begin, std::size_t end) { ranges.emplace_back(begin, end); });
  EXPECT_EQ(ranges, (std::vector<std::pair<std::size_t, std::size_t>>{{0, 4}, {4, 8}, {8, 10}}));
}

TEST(Parallel, SplitsUntilEveryRangeIsFinished) {
  struct Range {
    std::size_t begin = 0, end = 0;
    std::size_t size() const { return end - begin; }
  };
  constexpr std::size_t size = 100'000;
  for (const unsigned threads : {1U, 2U, 5U}) {
    std::vector<int> finished(size, 0);
    split_in_parallel(
        Range{0, size}, threads,
        [](const Range& range) {
          const std::size_t third = range.begin + range.size() / 3;
          return std::pair{Range{range.begin, third}, Range{third, range.end}};
        },
        [&](const Range& range) {
          for (std::size_t i = range.begin; i < range.end; ++i) ++finished[i];
        });
    EXPECT_EQ(finished, std::vector<int>(size, 1)) << threads;
  }
}

TEST(Parallel, CountsTheMachinesProcessorsForNone) {
  EXPECT_GE(threads_to_use(0, "x"), 1U);
  EXPECT_EQ(threads_to_use(3, "x"), 3U);
  EXPECT_EQ(threads_to_use(max_threads, "x"), max_threads);
  EXPECT_THROW(threads_to_use(max_threads + 1, "x"), std::invalid_argument);
}

}  // namespace
}  // namespace touchmark
