/// What is asked of many points at once: one call, or one a tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::many {

enum class Kind : std::uint8_t {
  coherent,         ///< the positions of the trajectory slide, in their order
  incoherent,       ///< within reach of random places, in random order
  pointshell,       ///< points on a body a quarter as large, which turns and comes down on the mesh
  pointshell_close  ///< points on the mesh itself, shaken by less than the reach
};

std::string_view name_of(Kind kind) noexcept;
/// Nothing for another name.
std::optional<Kind> kind_named(std::string_view name) noexcept;

struct WorkloadSizes {
  std::size_t points = 100'000;      ///< a call's, coherent or not
  std::size_t shell_points = 1'000;  ///< a pointshell's
  std::size_t ticks = 200;           ///< calls of a pointshell
};

struct Workload {
  Kind kind;
  double reach = 0;                      ///< mesh units
  std::vector<std::vector<Vec3>> calls;  ///< the points of each call, all as many
};

/// The reach must be finite and above 0, and no size 0.
Workload make_workload(Kind kind, const TriangleMesh& mesh, double reach, const WorkloadSizes& sizes,
                       std::uint64_t seed);

}  // namespace touchmark::bench::experiments::many
