#include "bench/support/files/standard_descriptors.h"

#include <cerrno>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "bench/support/failures.h"
#include "bench/support/system/system_limit.h"

namespace touchmark::bench::support {

void reserve_standard_descriptors() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(descriptor, F_GETFD) >= 0) continue;
    // The lowest number that is free is this one. What was to be printed must not get lost without an error,
    // so standard output cannot be written to.
    const int opened = open("/dev/null", descriptor == STDERR_FILENO ? O_WRONLY : O_RDONLY);
    if (opened != descriptor) {
      const std::string why = opened < 0 ? described_with_limit(errno) : "another has its number";
      throw ResourceError(fmt::format("cannot reserve the closed descriptor {}: {}", descriptor, why));
    }
  }
}

}  // namespace touchmark::bench::support
