/// What this program was built from and how; filled in by CMake.
#pragma once

#include <string>
#include <vector>

namespace touchmark::bench::results {

struct BuildInfo {
  std::string version;     ///< the project's
  std::string commit;      ///< the working tree's, "-dirty" appended if it was changed; or "unknown"
  std::string compiler;    ///< name and version
  std::string flags;       ///< what every file was compiled with
  std::string build_type;  ///< Release, ...
  bool native = false;     ///< compiled for the building machine's processor only
};

struct LibraryVersion {
  std::string name;
  std::string version;
};

const BuildInfo& build_info();
/// Libraries found when the program was configured.
const std::vector<LibraryVersion>& library_versions();

}  // namespace touchmark::bench::results
