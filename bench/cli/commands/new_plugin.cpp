/// `touchmark new-plugin`: a detector of the user's own, to begin from.
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

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

/// Returns the last file's name, which is the detector's.
std::string_view write_example(const std::string& folder, const std::string& language) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const std::filesystem::path path(folder);
  if (error == std::errc::file_exists || error == std::errc::not_a_directory)
    throw std::invalid_argument(fmt::format("{}: is not a folder", folder));
  if (error) throw support::ResourceError(fmt::format("cannot create {}: {}", folder, error.message()));
  std::vector<NewPluginFile> files;
  std::ranges::copy_if(new_plugin_files, std::back_inserter(files),
                       [&](const NewPluginFile& file) { return file.language == language; });
  for (const NewPluginFile& file : files) expect_free(path / file.name);
  for (const NewPluginFile& file : files) {
    support::AtomicFile out((path / file.name).string());
    out.write(file.content);
    out.commit();
  }
  return files.back().name;
}

std::string next_steps(const std::string& folder, std::string_view file) {
  const std::string where = support::quoted(folder);
  constexpr std::string_view verify = "touchmark verify --mesh torus:20x20 --trajectory slide";
  if (file != "mine.cpp")
    return fmt::format("A detector is in {0}/{1}. Next:\n  {2} --steps 200 --plugin {0}/{1}\n", where, file,
                       verify);
  return fmt::format(
      "A detector is in {0}/{1}. Next:\n"
      "  cmake -S {0} -B {0}/build -DCMAKE_BUILD_TYPE=Release\n"
      "  cmake --build {0}/build\n"
      "  {2} --plugin {0}/build/libmine.so\n",
      where, file, verify);
}

}  // namespace

void add_new_plugin(CLI::App& program, ProgramContext& context) {
  static_cast<void>(context);
  const auto folder = std::make_shared<std::string>();
  const auto language = std::make_shared<std::string>("cpp");
  CLI::App* command = add_command(program, "new-plugin");
  add_value(*command, "folder", *folder, "DIR", "where its files go")->required();
  add_value(*command, "--language", *language, "NAME", "what the example is written in")
      ->check(CLI::IsMember({"cpp", "python", "javascript"}));
  command->footer(
      "In C++ it is built against the installed package. No file is written over.\n"
      "Example: touchmark new-plugin mine\n"
      "         touchmark new-plugin mine --language javascript\n");
  command->final_callback([folder, language] {
    const std::string_view file = write_example(*folder, *language);
    support::StandardOutput().write(next_steps(*folder, file));
  });
}

}  // namespace touchmark::bench::cli
