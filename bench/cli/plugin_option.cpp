#include "bench/cli/plugin_option.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/program.h"
#include "bench/workers/plugin_description.h"

namespace touchmark::bench::cli {
namespace {

void add_unnamed(const std::vector<std::string>& plugins, bool any_given,
                 std::vector<std::string>& detectors) {
  if (!any_given) detectors.clear();
  for (const std::string& plugin : plugins) {
    const auto names_it = [&](const std::string& detector) {
      return detector == plugin || detector.starts_with(plugin + ':');
    };
    if (std::ranges::none_of(detectors, names_it)) detectors.push_back(plugin);
  }
}

}  // namespace

std::vector<std::string> load_plugins(ProgramContext& context, const std::vector<std::string>& files) {
  std::vector<std::string> loaded;
  for (const std::string& file : files) {
    try {
      contestants::ContestantInfo info = workers::described_plugin(file);
      loaded.push_back(info.name);
      context.roster.add(std::move(info));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("--plugin {}: {}", file, error.what()));
    }
  }
  return loaded;
}

std::vector<std::string> plugins_given(const CLI::App& command) {
  return command.get_option("--plugin")->results();
}

void add_plugins(CLI::App& command, ProgramContext& context, std::vector<std::string>* detectors) {
  command
      .add_option_function<std::vector<std::string>>(
          "--plugin",
          [&command, &context, detectors](const std::vector<std::string>& files) {
            const std::vector<std::string> loaded = load_plugins(context, files);
            if (detectors != nullptr) add_unnamed(loaded, command.count("--detector") > 0, *detectors);
          },
          "a contestant of yours: a shared object that keeps to touchmark/contestant.h (touchmark "
          "new-plugin), or a script in Python or JavaScript; repeatable")
      ->type_name("FILE")
      ->expected(1)
      ->take_all();
}

}  // namespace touchmark::bench::cli
