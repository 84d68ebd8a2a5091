#include "bench/contestants/plugins/plugin_kind.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "bench/contestants/plugins/c_plugin.h"
#include "bench/contestants/plugins/script_plugin.h"

namespace touchmark::bench::contestants {
namespace {

constexpr std::array kinds{
    PluginKind{".so", "touchmark-worker-plugin", "a shared object", load_c_plugin},
    PluginKind{".py", "touchmark-worker-plugin", "a script in Python",
               [](const std::string& path) { return load_script_plugin(python, path); }},
    PluginKind{".mjs", "touchmark-worker-plugin", "a module in JavaScript",
               [](const std::string& path) { return load_script_plugin(javascript, path); }},
};

/// libmine.so, and libmine.so.1.2 as well.
bool has_extension(const std::string& name, std::string_view extension) {
  const std::size_t found = name.rfind(extension);
  if (found == std::string::npos || found == 0) return false;
  return name.find_first_not_of("0123456789.", found + extension.size()) == std::string::npos;
}

}  // namespace

const PluginKind& plugin_kind_of(const std::string& path) {
  const std::string name = std::filesystem::path(path).filename().string();
  const auto found = std::ranges::find_if(
      kinds, [&](const PluginKind& kind) { return has_extension(name, kind.extension); });
  if (found != kinds.end()) return *found;
  std::vector<std::string> known;
  for (const PluginKind& kind : kinds) known.push_back(fmt::format("{} ({})", kind.extension, kind.what));
  throw std::invalid_argument(fmt::format("its name ends in none of {}", fmt::join(known, ", ")));
}

ContestantInfo load_plugin(const std::string& path) { return plugin_kind_of(path).load(path); }

}  // namespace touchmark::bench::contestants
