#include "bench/cli/step_visits.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/results/steps_surroundings.h"
#include "bench/support/beside_this_program.h"
#include "bench/support/raw_lists.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::cli {
namespace {

using measurement::ResultRow;
using support::put_list, support::put_number, support::put_text;

/// The detectors are built once more, and a larger mesh takes too long for pictures.
constexpr std::size_t most_triangles = 2'000'000;

bool is_traced(const ResultRow& row) {
  constexpr std::array<std::string_view, 3> detectors{"aabb-tree", "grid-group", "sphere-cluster"};
  // The published forms look at every group or sphere of a probe's cell, or at all.
  return row.log != nullptr && !row.log->ns.empty() &&
         std::ranges::find(detectors, row.detector) != detectors.end() &&
         row.options.find("lookup=scan") == std::string::npos;
}

void put_mesh(std::FILE* to, const TriangleMesh& mesh) {
  std::vector<double> coordinates;
  for (const Vec3& vertex : mesh.vertices())
    coordinates.insert(coordinates.end(), {vertex.x(), vertex.y(), vertex.z()});
  put_list(to, std::span<const double>(coordinates));
  put_list(to, mesh.triangles());
  put_list(to, mesh.ids());
}

void put_trace(std::FILE* to, const workload::Workload& workload, std::size_t trace, std::string_view query) {
  put_text(to, workload.trajectories[trace]);
  put_text(to, query);
  std::vector<std::array<double, 5>> steps;
  for (const workload::Step& step : workload.traces[trace]) {
    const Vec3& center = step.probe.center;
    steps.push_back({center.x(), center.y(), center.z(), step.probe.radius, step.reach});
  }
  put_list(to, std::span<const std::array<double, 5>>(steps));
}

void put_row(std::FILE* to, const workload::Workload& workload, const ResultRow& row) {
  const auto trace = std::ranges::find(workload.trajectories, row.trajectory) - workload.trajectories.begin();
  put_number(to, static_cast<std::uint64_t>(trace));
  put_text(to, row.detector);
  put_text(to, row.options);
  std::vector<std::uint64_t> ranges;
  for (const workload::StepRange& range : row.log->ranges)
    ranges.insert(ranges.end(), {range.begin, range.end});
  put_list(to, std::span<const std::uint64_t>(ranges));
  const std::vector<std::size_t> noted = results::noted_steps({&row});
  put_list(to, std::span<const std::uint64_t>(std::vector<std::uint64_t>(noted.begin(), noted.end())));
}

void put_questions(std::FILE* to, const std::string& run_id, const workload::Workload& workload,
                   const std::vector<const ResultRow*>& rows) {
  put_text(to, run_id);
  put_mesh(to, workload.mesh);
  put_number(to, workload.traces.size());
  for (std::size_t trace = 0; trace < workload.traces.size(); ++trace)
    put_trace(to, workload, trace, workload::name_of(rows.front()->query));
  put_number(to, rows.size());
  for (const ResultRow* row : rows) put_row(to, workload, *row);
}

/// Runs the program beside this one with these files as standard input and output. Returns whether it
/// succeeded.
bool run_tracer(std::FILE* input, std::FILE* output) {
  std::string program = support::beside_this_program("touchmark-tracer");
  std::array<char*, 2> arguments{program.data(), nullptr};
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, fileno(input), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, fileno(output), STDOUT_FILENO);
  pid_t process = 0;
  const int error = posix_spawn(&process, program.c_str(), &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  int status = 0;
  while (error == 0 && waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return error == 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::string content_of(std::FILE* file) {
  std::string text;
  std::array<char, 1 << 16> buffer;
  std::rewind(file);
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file))
    text.append(buffer.data(), count);
  return text;
}

}  // namespace

std::optional<std::string> step_visits(const std::string& run_id, const workload::Workload& workload,
                                       const std::vector<ResultRow>& rows, const TracerFiles& files) {
  std::vector<const ResultRow*> traced;
  for (const ResultRow& row : rows)
    if (is_traced(row)) traced.push_back(&row);
  if (traced.empty() || workload.mesh.size() > most_triangles) return std::nullopt;
  std::FILE* const input = files.input.get();
  put_questions(input, run_id, workload, traced);
  if (std::fflush(input) == 0 && std::ferror(input) == 0 && std::fseek(input, 0, SEEK_SET) == 0 &&
      run_tracer(input, files.output.get()))
    return content_of(files.output.get());
  fmt::print(
      stderr,
      "touchmark: what the slowest steps looked at is not known, since touchmark-tracer did not tell\n");
  return std::nullopt;
}

}  // namespace touchmark::bench::cli
