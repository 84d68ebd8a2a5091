/// How a worker ends whose contestant cannot answer any more. Queries cannot throw, so that whoever finds it
/// out deep inside one calls this.
#pragma once

#include <string>

namespace touchmark::bench::contestants {

/// Tells whoever asked, if anybody, and does not return.
using TellBroken = void (*)(const std::string& why) noexcept;

/// Whom end_as_broken tells. A worker sets it before it asks anybody.
void set_tell_broken(TellBroken tell) noexcept;

/// Ends the process; `why` is one line, which becomes the status "crashed:WHY".
[[noreturn]] void end_as_broken(const std::string& why) noexcept;

}  // namespace touchmark::bench::contestants
