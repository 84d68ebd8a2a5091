/// A contestant in Python: a script with a class Detector. docs/plugins.md says what it holds.
#pragma once

#include <string>

#include "bench/contestants/contestant_info.h"

namespace touchmark::bench::contestants {

/// Starts Python and has it load the script. Throws std::invalid_argument that says what keeps it from being
/// a contestant. One a process.
ContestantInfo load_python_plugin(const std::string& path);

}  // namespace touchmark::bench::contestants
