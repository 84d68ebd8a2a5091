/// The example of docs/examples/plugin, which the program carries with it.
#pragma once

#include <array>
#include <string_view>

namespace touchmark::bench::cli {

struct NewPluginFile {
  std::string_view name, content;
};

extern const std::array<NewPluginFile, 2> new_plugin_files;

}  // namespace touchmark::bench::cli
