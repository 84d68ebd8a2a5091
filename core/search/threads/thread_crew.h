/// Threads that wait for work, so that a call need not start any.
#pragma once

#include <cstddef>
#include <memory>

namespace touchmark {

/// One call at a time. Threads are started by the first call that wants them, and end with the crew.
class ThreadCrew {
 public:
  ThreadCrew() noexcept;
  ThreadCrew(ThreadCrew&&) noexcept;
  ThreadCrew& operator=(ThreadCrew&&) noexcept;
  ~ThreadCrew();

  /// Has so many threads at hand, the caller's one of them. Throws std::system_error where one cannot be
  /// started, and std::bad_alloc.
  void reserve(std::size_t threads);
  /// Calls work(part) once for every part below `parts`, from at most so many threads, the caller's one of
  /// them, and no more than were reserved. Returns when all are done. A thread that wakes up too late to
  /// help is not waited for.
  template <class Work>
  void run(std::size_t threads, std::size_t parts, const Work& work) {
    run(
        threads, parts,
        [](const void* what, std::size_t part) noexcept { (*static_cast<const Work*>(what))(part); }, &work);
  }

 private:
  using Function = void (*)(const void*, std::size_t) noexcept;
  void run(std::size_t threads, std::size_t parts, Function function, const void* work);

  struct Crew;
  std::unique_ptr<Crew> crew_;
};

}  // namespace touchmark
