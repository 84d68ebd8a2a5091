/// The machine a run was made on, as far as it can be told without naming it.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace touchmark::bench::results {

struct SystemInfo {
  std::string cpu_model;  ///< "unknown" where it cannot be read
  int cores = 0;          ///< how many this process may use
  std::string governor;   ///< frequency scaling's; "unknown" where it cannot be read
  std::array<double, 3> load_average{};
  std::string date;  ///< UTC, ISO 8601
};

SystemInfo system_info();

/// Tells machines apart without naming one: a hash over processor, cores and, where there is one, the
/// machine's random id. Machines made from one image may share it.
std::string machine_fingerprint();

/// The last of the cores this process may use, if there are at least two: one for the workers alone.
std::optional<int> core_for_workers();

/// A file's name in place of an absolute path, also behind "--option="; anything else as it is.
std::string without_directories(const std::string& text);

}  // namespace touchmark::bench::results
