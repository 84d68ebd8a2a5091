#include "bench/support/files/standard_output.h"

#include <cerrno>
#include <csignal>
#include <cstdio>

#include <fmt/format.h>

#include "bench/support/failures.h"
#include "bench/support/system/system_limit.h"

namespace touchmark::bench::support {
namespace {

/// After a failed write.
bool refuse_or_stop(int error) {
  if (error == EPIPE) return false;
  throw ResourceError(fmt::format("cannot write to standard output: {}", described_with_limit(error)));
}

}  // namespace

StandardOutput::StandardOutput() { std::signal(SIGPIPE, SIG_IGN); }

bool StandardOutput::write(std::string_view text) {
  return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() || refuse_or_stop(errno);
}

bool StandardOutput::finish() { return std::fflush(stdout) == 0 || refuse_or_stop(errno); }

}  // namespace touchmark::bench::support
