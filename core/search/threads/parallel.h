/// Shares out the construction of a structure to several threads.
///
/// What is built has the same bits for any number of them: a piece of the work depends on its number alone,
/// and no two pieces write to the same place.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace touchmark {

/// No more threads than this may be asked for.
inline constexpr unsigned max_threads = 256;

/// Returns how many threads are asked for, where 0 stands for one a processor. Throws std::invalid_argument,
/// naming who was asked, for more than max_threads.
unsigned threads_to_use(unsigned asked, const char* who);

/// Calls work(thread, piece) once for every piece below `count`, from at most so many threads at a time, of
/// which the caller's is number 0. Lower pieces are begun first. Where some throw, the rest is not begun, and
/// what the lowest of them threw reaches the caller when all have ended. Where the system gives fewer
/// threads, these do all the work.
void in_parallel(std::size_t count, unsigned threads,
                 const std::function<void(unsigned thread, std::size_t piece)>& work);

/// Calls work(begin, end) for ranges that together are [0, size), each but the last of `length`.
template <class Work>
void in_ranges(std::size_t size, std::size_t length, unsigned threads, const Work& work) {
  in_parallel((size + length - 1) / length, threads, [&](unsigned, std::size_t piece) {
    work(piece * length, std::min((piece + 1) * length, size));
  });
}

/// Splits a range in two, and what is large again and again: halves = split(range). What is small is left to
/// finish(range). The calls for disjoint ranges may run at the same time. One thread finishes all at once.
template <class Range, class Split, class Finish>
void split_in_parallel(const Range& all, unsigned threads, const Split& split, const Finish& finish) {
  // So many small ranges that threads come to their end together, but none too small to be worth it.
  constexpr std::size_t pieces_a_thread = 16, least = 1024;
  const std::size_t small =
      threads > 1 ? std::max<std::size_t>(all.size() / (pieces_a_thread * threads), least) : all.size();
  std::vector<Range> open, done;
  const auto sort_in = [&](const Range& range) { (range.size() > small ? open : done).push_back(range); };
  sort_in(all);
  while (!open.empty()) {
    const std::vector<Range> wave = std::exchange(open, {});
    std::vector<std::pair<Range, Range>> halves(wave.size());
    in_parallel(wave.size(), threads, [&](unsigned, std::size_t i) { halves[i] = split(wave[i]); });
    for (const auto& [left, right] : halves) {
      sort_in(left);
      sort_in(right);
    }
  }
  in_parallel(done.size(), threads, [&](unsigned, std::size_t i) { finish(done[i]); });
}

}  // namespace touchmark
