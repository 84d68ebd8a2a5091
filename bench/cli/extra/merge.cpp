/// `touchmark merge`: the job files of a sweep as one results CSV.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/batch/merged.h"
#include "bench/cli/extra/extra_commands.h"
#include "bench/cli/options.h"
#include "bench/results/results_csv.h"
#include "bench/support/files/atomic_file.h"
#include "bench/support/numbers.h"

namespace touchmark::bench::cli {
namespace {

namespace fs = std::filesystem;

struct MergeOptions {
  std::vector<std::string> paths;
  std::string out, manifest, machine;
  bool accuracy_only = false;
};

bool is_job_file(const fs::path& path) {
  return path.extension() == ".json" && support::is_hex(path.stem().string());
}

std::vector<batch::FoundJob> jobs_of(const std::vector<std::string>& folders) {
  std::vector<batch::FoundJob> jobs;
  for (const std::string& folder : folders) {
    std::vector<std::string> paths;
    try {
      for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (is_job_file(entry.path())) paths.push_back(entry.path().string());
    } catch (const fs::filesystem_error& error) {
      throw std::invalid_argument(fmt::format("{}: {}", folder, error.code().message()));
    }
    if (paths.empty()) throw std::invalid_argument(fmt::format("{}: no finished job in it", folder));
    std::ranges::sort(paths);
    for (const std::string& path : paths) jobs.push_back(batch::found_job(path));
  }
  return jobs;
}

void keep_machine(std::vector<batch::FoundJob>& jobs, const std::string& machine) {
  std::erase_if(jobs, [&](const batch::FoundJob& job) { return !job.result.machine.starts_with(machine); });
  if (jobs.empty())
    throw std::invalid_argument(fmt::format("--machine \"{}\": no job is from there", machine));
}

void merge(const MergeOptions& options) {
  std::optional<batch::Manifest> manifest;
  if (!options.manifest.empty()) manifest = batch::Manifest::read(options.manifest);
  std::vector<batch::FoundJob> jobs = jobs_of(options.paths);
  if (!options.machine.empty()) keep_machine(jobs, options.machine);
  if (!options.accuracy_only) batch::expect_one_machine(jobs);
  for (batch::FoundJob& job : jobs)
    if (options.accuracy_only || !job.timed) batch::drop_times(job);
  jobs = batch::in_order(std::move(jobs), manifest);
  for (batch::FoundJob& job : jobs) batch::note_source(job);
  support::AtomicFile file(options.out);
  file.write(support::csv_line(results::names_of(results::results_columns())));
  for (const batch::FoundJob& job : jobs) file.write(support::csv_line(job.result.fields));
  file.commit();
  fmt::print(stderr, "touchmark: {} rows\n", jobs.size());
}

}  // namespace

void add_merge(CLI::App& program, ProgramContext&) {
  const auto options = std::make_shared<MergeOptions>();
  CLI::App* command = add_command(program, "merge");
  add_value(*command, "dir", options->paths, "DIR", "folders of touchmark run")->required();
  add_value(*command, "--out", options->out, "FILE", "the CSV file")->required();
  add_value(*command, "--manifest", options->manifest, "FILE", "its jobs in its order; none may be missing");
  command->add_flag("--accuracy-only", options->accuracy_only,
                    "leave out times and heap_bytes; the rest may come from any machines");
  add_value(*command, "--machine", options->machine, "CODE", "only jobs of the machine whose code begins so");
  command->footer(
      "Times of different machines, or of different builds, do not mix: status 2, and which they are.\n"
      "Example: touchmark merge jobs --manifest sweep.json --out results.csv\n"
      "         touchmark merge here/jobs there/jobs --accuracy-only --out accuracy.csv\n");
  command->final_callback([options] { merge(*options); });
}

}  // namespace touchmark::bench::cli
