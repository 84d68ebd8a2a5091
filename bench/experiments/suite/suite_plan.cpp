#include "bench/experiments/suite/suite_plan.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "bench/meshes/meshes.h"
#include "bench/meshes/sized_meshes.h"
#include "bench/support/random.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::experiments::suite {
namespace {

constexpr std::array hands{"hand", "hand:free", "hand:tap"};
constexpr std::array moving{"slide", "approach", "hover"};
/// Recorded hands move 0.004 % of the diagonal a tick at the median, and 0.11 % at 99 %.
constexpr std::array speeds_of_hands{"0.01%", "0.2%"}, speeds_of_stress{"0.7%", "5%"};
constexpr std::size_t cells_a_stress = 6;
constexpr std::array reaches{"0.05%", "0.5%", "5%", "inf"};

/// Few triangles of this kind are as hard as many of others.
constexpr std::string_view slow_kind = "large-soup";
constexpr std::uint64_t slow_kind_triangles = 5000;

/// Scans and models that packages install.
constexpr std::array files{"/usr/share/glmark2/models/horse.3ds", "/usr/share/glmark2/models/cat.3ds",
                           "/usr/share/glmark2/models/asteroid-high.3ds"};

/// Counts how often each property of a cell was chosen.
using Counts = std::map<std::string, double>;

/// Returns what is to come up equally often. In all cells together each of these does, so that what is chosen
/// stands for all.
std::vector<std::string> properties_of(const SuiteCell& cell) {
  const std::string query(workload::name_of(cell.query));
  return {cell.trajectory, query + " within " + cell.reach, cell.trajectory + ' ' + query,
          cell.trajectory + " within " + cell.reach};
}

double rarity(const std::vector<std::string>& properties, Counts& counts) {
  double sum = 0;
  for (const std::string& property : properties) sum += 1 / (1 + counts[property]);
  return sum;
}

/// Takes the cell out of `left` whose properties came up least, in the mesh and in all.
SuiteCell take_rarest(std::vector<SuiteCell>& left, Counts& of_mesh, Counts& of_all) {
  const auto score = [&](const SuiteCell& cell) {
    const std::vector<std::string> properties = properties_of(cell);
    return rarity(properties, of_mesh) + rarity(properties, of_all);
  };
  auto best = left.begin();
  double most = -1;
  for (auto cell = left.begin(); cell != left.end(); ++cell)
    if (const double here = score(*cell); here > most) best = cell, most = here;
  SuiteCell taken = *best;
  left.erase(best);
  for (const std::string& property : properties_of(taken)) {
    ++of_mesh[property];
    ++of_all[property];
  }
  return taken;
}

}  // namespace

std::size_t SuitePlan::cells() const noexcept {
  std::size_t count = 0;
  for (const SuiteMesh& planned : meshes) count += planned.cells.size();
  return count;
}

std::vector<SuiteCell> every_cell() {
  std::vector<SuiteCell> cells;
  const auto add = [&cells](const std::string& trajectory, bool stress) {
    for (const workload::Query query : workload::all_queries) {
      for (const std::string reach : reaches) {
        if (reach == "inf" && query != workload::Query::nearest) continue;
        cells.push_back({trajectory, query, reach, stress});
      }
    }
  };
  for (const char* hand : hands) add(hand, false);
  for (const char* shape : moving) {
    for (const char* speed : speeds_of_hands) add(fmt::format("{}:speed={}", shape, speed), false);
    for (const char* speed : speeds_of_stress) add(fmt::format("{}:speed={}", shape, speed), true);
  }
  add("jump", true);
  return cells;
}

std::vector<std::string> suite_meshes(std::uint64_t triangles) {
  const std::array sizes{triangles, triangles / 3, 2 * triangles, triangles / 6};
  std::vector<std::string> meshes;
  for (const meshes::NamedMesh& named : meshes::named_meshes()) {
    if (named.name == "bunny" && named.available) meshes.emplace_back("bunny");
    if (named.name.starts_with("dragon") && named.available) meshes.emplace_back("dragon:3");
  }
  for (const char* file : files) {
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored)) meshes.emplace_back(file);
  }
  std::size_t next = 0;
  for (const meshes::SizedMesh& sized : meshes::sized_meshes()) {
    const std::string_view form = sized.form;
    const std::string_view kind = form.substr(0, form.find(':'));
    const std::uint64_t size =
        kind == slow_kind ? std::min(triangles, slow_kind_triangles) : sizes[next++ % sizes.size()];
    meshes.push_back(fmt::format("{}:{}", kind, std::max(size, sized.min_triangles)));
  }
  meshes.push_back(fmt::format("soup:{}", 2 * triangles));
  for (const char* name : {"icosphere:5", "torus:400x8", "thin-plate", "sliver-fan"})
    meshes.emplace_back(name);
  return meshes;
}

SuitePlan make_plan(const std::vector<std::string>& meshes, std::size_t cells_each, std::uint64_t seed,
                    bool emptied) {
  support::Random random(seed);
  SuitePlan plan;
  std::vector<std::array<std::vector<SuiteCell>, 2>> left;  // cells of hands, and of the stress
  std::vector<Counts> of_mesh(meshes.size());
  Counts of_all;
  for (const std::string& mesh : meshes) {
    plan.meshes.push_back({mesh, {}});
    std::vector<SuiteCell> all = every_cell();
    random.shuffle(all);  // decides between cells whose properties came up equally often
    auto& sections = left.emplace_back();
    for (SuiteCell& cell : all) sections[cell.stress ? 1 : 0].push_back(std::move(cell));
  }
  for (std::size_t round = 0; round < std::min(cells_each, every_cell().size()); ++round) {
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      const bool stress =
          left[i][0].empty() || (round % cells_a_stress == cells_a_stress - 1 && !left[i][1].empty());
      plan.meshes[i].cells.push_back(take_rarest(left[i][stress ? 1 : 0], of_mesh[i], of_all));
      SuiteCell& cell = plan.meshes[i].cells.back();
      cell.l2 = emptied && !stress;
      cell.cold = cell.l2 && round == 0;
    }
  }
  return plan;
}

}  // namespace touchmark::bench::experiments::suite
