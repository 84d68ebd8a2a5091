/// What a plug-in says that it is, asked in a worker: loading it may crash, hang or print.
#pragma once

#include <string>

#include "bench/contestants/contestant_info.h"

namespace touchmark::bench::workers {

/// Returns the contestant of this file. It is built in workers alone, as all are. Throws
/// std::invalid_argument for what is no plug-in, and ResourceError.
contestants::ContestantInfo described_plugin(const std::string& path);

}  // namespace touchmark::bench::workers
