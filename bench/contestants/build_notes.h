/// What the user should know of how something was built, from a process that need not have the user's
/// terminal: remarks are kept until somebody passes them on. A worker sends them with its replies.
#pragma once

#include <string>
#include <vector>

namespace touchmark::bench::contestants {

/// One line. Of one thread at a time.
void remark(std::string text);

/// Returns the remarks since the last call.
std::vector<std::string> take_remarks();

}  // namespace touchmark::bench::contestants
