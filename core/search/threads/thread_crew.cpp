#include "core/search/threads/thread_crew.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace touchmark {

struct ThreadCrew::Crew {
  ~Crew() {
    {
      const std::lock_guard lock(mutex);
      ends = true;
    }
    wake.notify_all();
    for (std::thread& thread : threads) thread.join();
  }

  /// Takes part after part until none is left.
  void take_parts() noexcept {
    for (std::size_t part = next++; part < parts; part = next++) function(work, part);
  }

  void serve(std::size_t number) {
    std::uint64_t seen = 0;
    std::unique_lock lock(mutex);
    for (;;) {
      wake.wait(lock, [&] { return ends || call != seen; });
      if (ends) return;
      seen = call;
      if (!is_open || number >= wanted) continue;
      ++busy;
      lock.unlock();
      take_parts();
      lock.lock();
      if (--busy == 0) done.notify_one();
    }
  }

  std::mutex mutex;
  std::condition_variable wake, done;
  std::vector<std::thread> threads;
  // The rest is guarded by the mutex; what take_parts reads does not change while anyone is busy.
  bool ends = false;
  bool is_open = false;    ///< may others join the call?
  std::uint64_t call = 0;  ///< its number
  std::size_t wanted = 0;  ///< threads besides the caller's
  std::size_t busy = 0;    ///< how many of these take parts now
  Function function = nullptr;
  const void* work = nullptr;
  std::size_t parts = 0;
  std::atomic<std::size_t> next = 0;
};

ThreadCrew::ThreadCrew() noexcept = default;
ThreadCrew::ThreadCrew(ThreadCrew&&) noexcept = default;
ThreadCrew& ThreadCrew::operator=(ThreadCrew&&) noexcept = default;
ThreadCrew::~ThreadCrew() = default;

void ThreadCrew::reserve(std::size_t threads) {
  if (threads <= 1) return;
  if (crew_ == nullptr) crew_ = std::make_unique<Crew>();
  crew_->threads.reserve(threads - 1);
  while (crew_->threads.size() < threads - 1)
    crew_->threads.emplace_back(
        [crew = crew_.get(), number = crew_->threads.size()] { crew->serve(number); });
}

void ThreadCrew::run(std::size_t threads, std::size_t parts, Function function, const void* work) {
  if (crew_ == nullptr || threads <= 1 || parts <= 1) {
    for (std::size_t part = 0; part < parts; ++part) function(work, part);
    return;
  }
  Crew& crew = *crew_;
  {
    const std::lock_guard lock(crew.mutex);
    crew.function = function;
    crew.work = work;
    crew.parts = parts;
    crew.next = 0;
    crew.wanted = std::min(threads, parts) - 1;
    crew.is_open = true;
    ++crew.call;
  }
  crew.wake.notify_all();
  crew.take_parts();
  std::unique_lock lock(crew.mutex);
  crew.is_open = false;
  crew.done.wait(lock, [&] { return crew.busy == 0; });
}

}  // namespace touchmark
