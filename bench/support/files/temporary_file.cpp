#include "bench/support/files/temporary_file.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "bench/support/failures.h"

namespace touchmark::bench::support {

File temporary_file() {
  const char* const set = std::getenv("TMPDIR");
  const std::string folder = set != nullptr && *set != '\0' ? set : "/tmp";
  std::string path = folder + "/touchmark-XXXXXX";
  const int descriptor = mkostemp(path.data(), O_CLOEXEC);
  if (descriptor < 0)
    throw ResourceError(
        fmt::format("no temporary file can be made in {}: {}; set TMPDIR to a folder that can be written to",
                    folder, std::strerror(errno)));
  unlink(path.c_str());
  return File(fdopen(descriptor, "w+b"));
}

}  // namespace touchmark::bench::support
