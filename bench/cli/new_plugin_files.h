/// The examples of docs/examples/plugin, which the program carries with it.
#pragma once

#include <array>
#include <string_view>

namespace touchmark::bench::cli {

struct NewPluginFile {
  std::string_view language, name, content;
};

extern const std::array<NewPluginFile, 4> new_plugin_files;

}  // namespace touchmark::bench::cli
