/// A contestant from a shared object that keeps to core/contestant.h. Loading runs the author's code, so
/// only worker processes load: the program learns of it by workers/plugin_description.h.
#pragma once

#include <string>

#include "bench/contestants/contestant_info.h"
#include "core/contestant.h"

namespace touchmark::bench::contestants {

/// A contestant of a description that stays as it is. Throws std::invalid_argument that says what is wrong in
/// it.
ContestantInfo contestant_of(const touchmark_plugin& plugin, const std::string& path);

/// `path` has a slash. Throws std::invalid_argument that says what keeps it from being a contestant.
ContestantInfo load_c_plugin(const std::string& path);

}  // namespace touchmark::bench::contestants
