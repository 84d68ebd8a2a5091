/// The place of the programs that were built and installed with this one.
#pragma once

#include <filesystem>
#include <string_view>
#include <system_error>

namespace touchmark::bench::support {

/// Returns the path of a file in this program's folder; the name alone where that folder is not known.
inline std::filesystem::path beside_this_program(std::string_view name) {
  std::error_code unknown;
  return std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path() / name;
}

}  // namespace touchmark::bench::support
