#include "core/search/threads/parallel.h"

#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

namespace touchmark {

unsigned threads_to_use(unsigned asked, const char* who) {
  if (asked > max_threads)
    throw std::invalid_argument(std::string(who) + ": threads is " + std::to_string(asked) + ", more than " +
                                std::to_string(max_threads));
  if (asked > 0) return asked;
  return std::clamp(std::thread::hardware_concurrency(), 1U, max_threads);
}

void in_parallel(std::size_t count, unsigned threads,
                 const std::function<void(unsigned thread, std::size_t piece)>& work) {
  if (threads <= 1 || count <= 1) {
    for (std::size_t piece = 0; piece < count; ++piece) work(0, piece);
    return;
  }
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;  // guards the two below
  std::exception_ptr thrown;
  std::size_t thrown_by = std::numeric_limits<std::size_t>::max();
  const auto serve = [&](unsigned thread) noexcept {
    for (std::size_t piece = next++; piece < count; piece = next++) {
      try {
        work(thread, piece);
      } catch (...) {
        next = count;
        const std::lock_guard lock(mutex);
        if (piece >= thrown_by) continue;
        thrown = std::current_exception();
        thrown_by = piece;
      }
    }
  };
  std::vector<std::thread> others;
  others.reserve(threads - 1);
  try {
    while (others.size() + 1 < std::min<std::size_t>(threads, count))
      others.emplace_back(serve, static_cast<unsigned>(others.size() + 1));
  } catch (const std::system_error&) {
    // Those that there are do.
  }
  serve(0);
  for (std::thread& other : others) other.join();
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace touchmark
