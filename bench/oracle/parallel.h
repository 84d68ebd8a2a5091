#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <future>
#include <vector>

namespace touchmark::bench::oracle {

/// Calls work(begin, end) for consecutive pieces of [0, size) from several threads. Rethrows what `work`
/// throws.
template <class Work>
void in_parallel(std::size_t size, unsigned threads, const Work& work) {
  // Short enough to even out the load, long enough that neighbours help each other.
  constexpr std::size_t piece = 64;
  std::atomic<std::size_t> next = 0;
  const auto worker = [&] {
    for (std::size_t begin = next.fetch_add(piece); begin < size; begin = next.fetch_add(piece))
      work(begin, std::min(begin + piece, size));
  };
  std::vector<std::future<void>> others;
  const std::size_t pieces = (size + piece - 1) / piece;
  for (std::size_t i = 1; i < std::min<std::size_t>(threads, pieces); ++i)
    others.push_back(std::async(std::launch::async, worker));
  worker();
  for (std::future<void>& other : others) other.get();
}

}  // namespace touchmark::bench::oracle
