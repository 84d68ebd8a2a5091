/// Which worker program loads the file that `--plugin FILE` names. The one place that tells kinds of plug-ins
/// apart: the rest of the program knows a plug-in as a ContestantInfo with a path. For another kind, add a
/// row to the table in plugin_kind.cpp, with the function that makes a ContestantInfo of a path.
#pragma once

#include <string>
#include <string_view>

#include "bench/contestants/contestant_info.h"

namespace touchmark::bench::contestants {

struct PluginKind {
  std::string_view extension;       ///< how the file's name ends, with its dot
  std::string_view worker_program;  ///< beside this program
  std::string_view what;            ///< as an error message calls it
  /// What the worker loads it with. Throws std::invalid_argument that says what keeps it from being one.
  ContestantInfo (*load)(const std::string& path);
};

/// Throws std::invalid_argument for a file whose name has none of the extensions.
const PluginKind& plugin_kind_of(const std::string& path);

/// Loads a plug-in of whatever kind. Throws std::invalid_argument.
ContestantInfo load_plugin(const std::string& path);

}  // namespace touchmark::bench::contestants
