#include "bench/results/build_info.h"

#include "bench/generated/commit.h"
#include "bench/generated/configuration.h"

namespace touchmark::bench::results {

const BuildInfo& build_info() {
  static const BuildInfo info{TOUCHMARK_VERSION, TOUCHMARK_COMMIT,     TOUCHMARK_COMPILER,
                              TOUCHMARK_FLAGS,   TOUCHMARK_BUILD_TYPE, TOUCHMARK_NATIVE != 0};
  return info;
}

const std::vector<LibraryVersion>& library_versions() {
  static const std::vector<LibraryVersion> versions{TOUCHMARK_LIBRARY_VERSIONS};
  return versions;
}

}  // namespace touchmark::bench::results
