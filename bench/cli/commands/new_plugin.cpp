/// `touchmark new-plugin`: a detector of the user's own, to begin from.
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/new_plugin_files.h"
#include "bench/cli/options.h"
#include "bench/cli/program.h"
#include "bench/support/files/atomic_file.h"
#include "bench/support/files/standard_output.h"
#include "bench/support/shell_word.h"

namespace touchmark::bench::cli {
namespace {

/// What stands there already is somebody's work, a broken link included.
void expect_free(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::exists(std::filesystem::symlink_status(path, error)))
    throw std::invalid_argument(fmt::format("{}: is there already, and is not written over", path.string()));
}

void write_example(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::filesystem::path path(folder);
  if (error == std::errc::file_exists || error == std::errc::not_a_directory)
    throw std::invalid_argument(fmt::format("{}: is not a folder", folder));
  if (error) throw support::ResourceError(fmt::format("cannot create {}: {}", folder, error.message()));
  for (const NewPluginFile& file : new_plugin_files) expect_free(path / file.name);
  for (const NewPluginFile& file : new_plugin_files) {
    support::AtomicFile out((path / file.name).string());
    out.write(file.content);
    out.commit();
  }
}

std::string next_steps(const std::string& folder) {
  const std::string where = support::quoted(folder);
  return fmt::format(
      "A detector is in {0}/mine.cpp. Next:\n"
      "  cmake -S {0} -B {0}/build -DCMAKE_BUILD_TYPE=Release\n"
      "  cmake --build {0}/build\n"
      "  touchmark verify --mesh torus:20x20 --trajectory slide --plugin {0}/build/libmine.so\n",
      where);
}

}  // namespace

void add_new_plugin(CLI::App& program, ProgramContext& context) {
  static_cast<void>(context);
  const auto folder = std::make_shared<std::string>();
  CLI::App* command = add_command(program, "new-plugin");
  add_value(*command, "folder", *folder, "DIR", "where CMakeLists.txt and mine.cpp go")->required();
  command->footer(
      "It is built against the installed package, and no file is written over.\n"
      "Example: touchmark new-plugin mine\n");
  command->final_callback([folder] {
    write_example(*folder);
    support::StandardOutput().write(next_steps(*folder));
  });
}

}  // namespace touchmark::bench::cli
