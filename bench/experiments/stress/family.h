/// What `touchmark stress` asks: families of questions that are hard in one way each. A new family is a
/// function and its line in families.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/workload/workload.h"

namespace touchmark::bench::experiments::stress {

/// Makes meshes and the questions about them. Equal seeds and numbers give equal ones; about `probes` in all,
/// at least a few for each mesh. Throws MeshError where no mesh can be made of it: every contestant refuses
/// it then.
using MakeQuestions = std::vector<workload::Workload> (*)(std::uint64_t seed, std::size_t probes);

struct Family {
  std::string_view name;
  std::string_view meaning;  ///< one sentence
  /// Every radius and reach is the exact distance rounded to a double, a double next to it, or zero.
  bool adversarial = true;
  MakeQuestions make = nullptr;
};

/// In the order of the report.
std::span<const Family> families();

/// Throws std::invalid_argument naming the nearest names.
const Family& family_named(std::string_view name);

}  // namespace touchmark::bench::experiments::stress
