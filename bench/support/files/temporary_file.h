/// A temporary file without a name.
#pragma once

#include <cstdio>
#include <memory>

namespace touchmark::bench::support {

struct CloseFile {
  void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

/// Opens one in the folder TMPDIR, or in /tmp where that is not set, to read and write. It is gone once it is
/// closed. Throws ResourceError naming the folder.
File temporary_file();

}  // namespace touchmark::bench::support
