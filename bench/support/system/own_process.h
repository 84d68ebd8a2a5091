/// Work in a process of its own, for libraries that may crash, hang or take all memory.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

namespace touchmark::bench::support {

struct ProcessLimits {
  std::uint64_t bytes;  ///< the address space beyond this process's; without effect under sanitizers
  std::chrono::milliseconds time;
};

/// Thrown where the process ended before its work: "crashed (Aborted)", "took more than 60 s",
/// "needed more than 2.0 GB".
class ProcessFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns what `work` writes in a copy of this process, which prints nothing; nothing where the system makes
/// no other process. Throws ProcessFailure, and what check_for_interrupt throws. `work` must throw nothing
/// but std::bad_alloc.
std::optional<std::string> in_own_process(const std::function<void(std::FILE*)>& work,
                                          const ProcessLimits& limits);

}  // namespace touchmark::bench::support
