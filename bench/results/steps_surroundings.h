/// Which steps of a run are worth a look at everything about them, and the triangles around their probes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/measurement/result_row.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::results {

/// How many of each row's slowest steps, and of its first wrong ones, are noted.
inline constexpr std::size_t slowest_noted = 10, wrong_noted = 20;
/// How many steps of a trace are noted at most: the rows' slowest first, then their second slowest, and so
/// on.
inline constexpr std::size_t max_noted = 240;

/// Returns the steps of the slowest answers, slowest first. Empty where the row was not timed.
std::vector<std::size_t> slowest_steps(const measurement::StepLog& log, std::size_t count);

/// Returns the steps of one trace to be noted, ascending: `rows` are of this trace and have logs.
std::vector<std::size_t> noted_steps(const std::vector<const measurement::ResultRow*>& rows);

/// The triangles around probes, each once, with corners in the mesh's own numbers.
class Surroundings {
 public:
  explicit Surroundings(const TriangleMesh& mesh);

  /// Returns the triangles nearest to the centre, as places in triangles(): at most `triangles_around`. None
  /// once so many triangles were looked at that a page would wait for them.
  std::vector<std::uint32_t> around(const Vec3& center);

  /// Their positions in the mesh.
  const std::vector<std::uint32_t>& triangles() const noexcept { return chosen_; }

 private:
  static constexpr std::size_t triangles_around = 48;
  static constexpr std::size_t max_looked_at = 200'000'000;

  const TriangleMesh& mesh_;
  std::size_t looked_at_ = 0;
  std::vector<std::uint32_t> chosen_;
  std::vector<std::uint32_t>
      places_;  ///< a triangle of the mesh each: its place in chosen_, from 1; 0: not chosen
};

}  // namespace touchmark::bench::results
