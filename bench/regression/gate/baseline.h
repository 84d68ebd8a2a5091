/// The gate's baseline: a CSV file of ratios, so that it can be written on one machine and read on another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/measurement/result_row.h"
#include "bench/regression/gate/bootstrap.h"

namespace touchmark::bench::regression::gate {

/// What is compared: a detector against a reference on the same steps.
struct GateKey {
  std::string mesh;  ///< its name
  std::string trajectory;
  std::string query;
  std::string detector;   ///< NAME[:options]
  std::string reference;  ///< likewise

  bool operator==(const GateKey&) const = default;
};

struct BaselineRow {
  GateKey key;
  std::uint64_t mesh_hash = 0;
  std::uint64_t trace_hash = 0;
  std::size_t steps = 0;  ///< replayed, of the trace's
  RatioInterval ratio;    ///< the detector's time over the reference's
  std::optional<measurement::WorkResult> work;
  std::optional<std::uint64_t> checksum;
  std::string version, commit, cpu;  ///< the program and machine that wrote it; not compared
};

class Baseline {
 public:
  /// Throws std::invalid_argument for a file that cannot be read or is no baseline, naming line and value.
  static Baseline read(const std::string& path);

  const BaselineRow* find(const GateKey& key) const noexcept;
  /// In place of the row with that key, or at the end.
  void put(BaselineRow row);
  std::string csv() const;

 private:
  std::vector<BaselineRow> rows_;
};

}  // namespace touchmark::bench::regression::gate
