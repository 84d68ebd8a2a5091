#include "bench/scenes/ros_packages.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bench/support/files/text_file.h"

namespace touchmark::bench::scenes {
namespace {

namespace fs = std::filesystem;

/// Returns the parts of an environment variable that ':' separates; none where it is not set.
std::vector<std::string> folders_of(const char* variable) {
  std::vector<std::string> folders;
  const char* const value = std::getenv(variable);
  std::string rest = value == nullptr ? "" : value;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    if (end > 0) folders.push_back(rest.substr(0, end));
    rest.erase(0, end + 1);
  }
  return folders;
}

/// True if the folder's package.xml names the package, or names none and the folder is called so.
bool is_package(const fs::path& folder, const std::string& name) {
  std::string text = support::read_text_file((folder / "package.xml").string());
  std::erase_if(text, [](unsigned char c) { return std::isspace(c) != 0; });
  if (text.find("<name>") == std::string::npos) return folder.filename() == name;
  return text.find("<name>" + name + "</name>") != std::string::npos;
}

/// As ROS crawls its path: a folder with a package.xml is a package, and none lies within another one.
std::optional<fs::path> found_below(const fs::path& folder, const std::string& name, int depth) {
  std::error_code ignored;
  if (fs::is_regular_file(folder / "package.xml", ignored))
    return is_package(folder, name) ? std::optional(folder) : std::nullopt;
  if (depth == 0) return std::nullopt;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (!entry.is_directory(ignored) || entry.path().filename().string().starts_with(".")) continue;
    if (std::optional<fs::path> found = found_below(entry.path(), name, depth - 1)) return found;
  }
  return std::nullopt;
}

}  // namespace

RosPackages::RosPackages(const std::vector<std::string>& given) {
  for (const std::string& text : given) {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos)
      throw std::invalid_argument(fmt::format("--package {}: must be NAME=DIR", text));
    const fs::path folder = text.substr(equals + 1);
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored))
      throw std::invalid_argument(fmt::format("--package {}: {} is no folder", text, folder.string()));
    given_.emplace_back(text.substr(0, equals), folder);
  }
}

std::optional<fs::path> RosPackages::folder_of(const std::string& name) const {
  constexpr int max_depth = 8;
  const auto by_hand = std::ranges::find(given_, name, [](const auto& one) { return one.first; });
  if (by_hand != given_.end()) return by_hand->second;
  std::error_code ignored;
  for (const std::string& prefix : folders_of("AMENT_PREFIX_PATH")) {
    const fs::path folder = fs::path(prefix) / "share" / name;
    if (fs::is_directory(folder, ignored)) return folder;
  }
  for (const std::string& folder : folders_of("ROS_PACKAGE_PATH"))
    if (std::optional<fs::path> found = found_below(folder, name, max_depth)) return found;
  return std::nullopt;
}

}  // namespace touchmark::bench::scenes
