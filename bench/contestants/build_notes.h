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

/// What a contestant that chooses for itself has chosen: options as one could have typed them. Of one thread
/// at a time.
void note_choice(std::string options);

/// Returns the choice noted last, since the last call; empty: none.
std::string take_choice();

}  // namespace touchmark::bench::contestants
