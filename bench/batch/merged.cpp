#include "bench/batch/merged.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "bench/results/results_csv.h"

namespace touchmark::bench::batch {

namespace {

std::string member(const nlohmann::json& run, const char* name) {
  const nlohmann::json& value = run.at(name);
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// Times of jobs with the same identity may stand in one table.
std::string identity_of(const JobResult& job) {
  const auto of = [&](const char* name) { return member(job.run, name); };
  return fmt::format("{}, {} cores, machine {}, commit {}, {} {}{}, {}", of("cpu"), of("cores"), job.machine,
                     of("commit"), of("build_type"), of("compiler"), of("native") == "true" ? " native" : "",
                     of("flags"));
}

std::size_t place_of(std::string_view column) {
  const auto columns = results::results_columns();
  const auto found = std::ranges::find(columns, column, [](const auto& one) { return one.name; });
  return static_cast<std::size_t>(found - columns.begin());
}

std::vector<std::string> sorting_key(const FoundJob& job) {
  std::vector<std::string> key;
  for (const char* name : {"mesh", "trajectory", "query", "radius", "reach", "detector", "options", "run_id"})
    key.push_back(job.result.fields[place_of(name)]);
  key.push_back(job.result.id);
  return key;
}

std::map<std::string, std::size_t> positions_of(const Manifest& manifest) {
  std::map<std::string, std::size_t> positions;
  for (const BatchMesh& planned : manifest.meshes)
    for (const BatchJob& job : planned.jobs) positions.emplace(job.id, positions.size());
  return positions;
}

void expect_all_of(const std::map<std::string, std::size_t>& positions, const std::vector<FoundJob>& jobs) {
  std::set<std::string> found;
  for (const FoundJob& job : jobs) found.insert(job.result.id);
  std::size_t missing = 0;
  std::string first;
  for (const auto& [id, position] : positions) {
    if (found.contains(id)) continue;
    if (missing++ == 0) first = id;
  }
  if (missing == 0) return;
  throw std::invalid_argument(
      fmt::format("{} of the manifest's {} jobs are missing, one is {}", missing, positions.size(), first));
}

}  // namespace

FoundJob found_job(const std::string& path) {
  FoundJob job{path, read_job(path), false};
  job.timed = job.result.run.at("effort").at("repetitions").get<std::size_t>() > 0;
  return job;
}

void drop_times(FoundJob& job) {
  job.timed = false;
  for (std::size_t i = 0; i < job.result.fields.size(); ++i) {
    const results::Presence presence = results::results_columns()[i].presence;
    if (presence == results::Presence::built || presence == results::Presence::timed)
      job.result.fields[i].clear();
  }
}

void note_source(FoundJob& job) {
  job.result.fields[place_of("source")] = fmt::format("{} on {}", job.path, job.result.machine);
}

void expect_one_machine(const std::vector<FoundJob>& jobs) {
  std::map<std::string, std::vector<const FoundJob*>> machines;
  for (const FoundJob& job : jobs)
    if (job.timed) machines[identity_of(job.result)].push_back(&job);
  if (machines.size() < 2) return;
  std::string list;
  for (const auto& [identity, of_it] : machines)
    list += fmt::format("{}{} jobs ({} and others) on {}", list.empty() ? "" : "; ", of_it.size(),
                        of_it.front()->path, identity);
  throw std::invalid_argument(
      fmt::format("times of {} machines or builds do not mix: {} (--accuracy-only merges what does not "
                  "depend on them, --machine takes those of one)",
                  machines.size(), list));
}

std::vector<FoundJob> in_order(std::vector<FoundJob> jobs, const std::optional<Manifest>& manifest) {
  const std::map<std::string, std::size_t> positions =
      manifest ? positions_of(*manifest) : std::map<std::string, std::size_t>{};
  if (manifest) {
    std::erase_if(jobs, [&](const FoundJob& job) { return !positions.contains(job.result.id); });
    expect_all_of(positions, jobs);
  }
  const auto position_of = [&](const FoundJob& job) { return manifest ? positions.at(job.result.id) : 0; };
  std::ranges::sort(jobs, [&](const FoundJob& a, const FoundJob& b) {
    return std::pair(position_of(a), sorting_key(a)) < std::pair(position_of(b), sorting_key(b));
  });
  const auto same = [](const FoundJob& a, const FoundJob& b) {
    return a.result.id == b.result.id && a.result.fields == b.result.fields;
  };
  jobs.erase(std::unique(jobs.begin(), jobs.end(), same), jobs.end());
  std::map<std::string, const FoundJob*> timed;
  for (const FoundJob& job : jobs) {
    if (!job.timed) continue;
    const auto [other, first] = timed.emplace(job.result.id, &job);
    if (!first)
      throw std::invalid_argument(
          fmt::format("job {} was timed twice: {} and {}", job.result.id, other->second->path, job.path));
  }
  return jobs;
}

}  // namespace touchmark::bench::batch
