/// One function a family; families.cpp says what each is for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bench/workload/workload.h"

namespace touchmark::bench::stress {

// meshes_of_bad_shape.cpp
std::vector<Workload> needles(std::uint64_t seed, std::size_t probes);
std::vector<Workload> caps(std::uint64_t seed, std::size_t probes);
std::vector<Workload> degenerate(std::uint64_t seed, std::size_t probes);
std::vector<Workload> spanning_triangle(std::uint64_t seed, std::size_t probes);
std::vector<Workload> one_cell(std::uint64_t seed, std::size_t probes);
std::vector<Workload> single_triangle(std::uint64_t seed, std::size_t probes);
std::vector<Workload> empty_mesh(std::uint64_t seed, std::size_t probes);

// scaled_and_offset_meshes.cpp
std::vector<Workload> thresholds(std::uint64_t seed, std::size_t probes);
std::vector<Workload> scales(std::uint64_t seed, std::size_t probes);
std::vector<Workload> offsets(std::uint64_t seed, std::size_t probes);
std::vector<Workload> ball_centre(std::uint64_t seed, std::size_t probes);

// probes_on_a_lattice.cpp
std::vector<Workload> radius_zero(std::uint64_t seed, std::size_t probes);
std::vector<Workload> ties(std::uint64_t seed, std::size_t probes);
std::vector<Workload> cell_borders(std::uint64_t seed, std::size_t probes);
std::vector<Workload> tangent(std::uint64_t seed, std::size_t probes);

// non_finite_probes.cpp
std::vector<Workload> huge(std::uint64_t seed, std::size_t probes);
std::vector<Workload> denormal(std::uint64_t seed, std::size_t probes);
std::vector<Workload> not_a_number(std::uint64_t seed, std::size_t probes);

// sweeps.cpp
std::vector<Workload> sweeps(std::uint64_t seed, std::size_t probes);
std::vector<Workload> far_sweeps(std::uint64_t seed, std::size_t probes);

// motions.cpp
std::vector<Workload> motions(std::uint64_t seed, std::size_t probes);

// near_ties.cpp
std::vector<Workload> near_ties(std::uint64_t seed, std::size_t probes);

// shared_features.cpp
std::vector<Workload> shared_features(std::uint64_t seed, std::size_t probes);

// control_family.cpp
std::vector<Workload> control_family(std::uint64_t seed, std::size_t probes);

}  // namespace touchmark::bench::stress
