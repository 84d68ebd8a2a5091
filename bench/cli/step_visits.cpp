#include "bench/cli/step_visits.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <span>
#include <stdexcept>

#include <fmt/format.h>
#include <unistd.h>

#include "bench/meshes/mesh_lists.h"
#include "bench/support/failures.h"
#include "bench/support/files/raw_lists.h"
#include "bench/support/files/temporary_file.h"
#include "bench/support/system/beside_this_program.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::cli {
namespace {

using support::put_list, support::put_text;

void put_trace(std::FILE* to, const std::vector<workload::Step>& trace) {
  std::vector<std::array<double, 5>> steps;
  for (const workload::Step& step : trace) {
    const Vec3& center = step.probe.center;
    steps.push_back({center.x(), center.y(), center.z(), step.probe.radius, step.reach});
  }
  put_list(to, std::span<const std::array<double, 5>>(steps));
}

}  // namespace

void print_visits(const workload::Workload& workload, workload::Query query, const std::string& detector,
                  std::vector<std::uint64_t> steps) {
  const std::vector<workload::Step>& trace = workload.traces.front();
  std::ranges::sort(steps);
  if (workload.scene) throw std::invalid_argument("--visits is of a mesh, and does not go with --scene");
  if (steps.back() >= trace.size())
    throw std::invalid_argument(
        fmt::format("--visits \"{}\" is none of the {} steps, which begin at 0", steps.back(), trace.size()));
  std::string program = support::beside_this_program("touchmark-tracer");
  if (!std::filesystem::exists(program))
    throw std::invalid_argument(
        "touchmark-tracer is missing; scripts/build-program touchmark-tracer builds it");
  const support::File input = support::temporary_file();
  meshes::put_mesh(input.get(), workload.mesh);
  put_text(input.get(), workload::name_of(query));
  put_trace(input.get(), trace);
  put_text(input.get(), detector);
  put_list(input.get(), std::span<const std::uint64_t>(steps));
  std::array<char*, 2> arguments{program.data(), nullptr};
  if (std::fflush(input.get()) == 0 && std::ferror(input.get()) == 0 &&
      std::fseek(input.get(), 0, SEEK_SET) == 0 && dup2(fileno(input.get()), STDIN_FILENO) >= 0)
    execv(program.c_str(), arguments.data());
  throw support::ResourceError(
      fmt::format("{} cannot be run, or the folder of temporary files is full", program));
}

}  // namespace touchmark::bench::cli
