/// Finds the folders of ROS packages, for the package:// addresses in a robot's file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace touchmark::bench::scenes {

/// Looks packages up as ROS does: first those given by hand, then AMENT_PREFIX_PATH (PREFIX/share/NAME), then
/// ROS_PACKAGE_PATH (folders with a package.xml of that name, at any depth).
class RosPackages {
 public:
  /// `given` are texts NAME=DIR. Throws std::invalid_argument for one without a name or whose DIR is no
  /// folder.
  explicit RosPackages(const std::vector<std::string>& given);

  /// Returns the package's folder; nothing where no package of this name is found.
  std::optional<std::filesystem::path> folder_of(const std::string& name) const;

 private:
  std::vector<std::pair<std::string, std::filesystem::path>> given_;
};

}  // namespace touchmark::bench::scenes
