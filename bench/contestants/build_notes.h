/// What the user should know of how something was built, from a process that need not have the user's
/// terminal: it is kept until somebody passes it on. A worker sends it with its replies.
#pragma once

#include <string>
#include <vector>

namespace touchmark::bench::contestants {

/// One line. Of one thread at a time.
void remark(std::string text);

/// Returns the remarks since the last call.
std::vector<std::string> take_remarks();

}  // namespace touchmark::bench::contestants
