#include "bench/cli/extra/scale_bodies.h"

#include <deque>
#include <optional>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "bench/cli/run_frame.h"
#include "bench/contestants/roster.h"
#include "bench/experiments/scaling/body_run.h"
#include "bench/experiments/scaling/mesh_sizes.h"
#include "bench/support/checked.h"
#include "bench/support/files/standard_output.h"

namespace touchmark::bench::cli {

namespace scaling = experiments::scaling;

namespace {

constexpr const char* default_body_counts = "10,100,1k,10k,100k";
constexpr const char* quick_body_counts = "10,100,1k";
constexpr scaling::SizesOf of_bodies{"bodies", 1, 1'000'000};

/// The fastest of ours, a plain loop and the rivals: `merged` would be built of all triangles.
std::vector<contestants::ContestantSpec> contestants_of(const std::vector<std::string>& names,
                                                        const contestants::Roster& roster) {
  std::vector<contestants::ContestantSpec> specs = roster.parse_all(names);
  if (!specs.empty()) return specs;
  for (contestants::ContestantSpec& spec : roster.forms(&contestants::Forms::scenes))
    if (spec.name == "sphere-cluster" || spec.name == "looped" || !roster.find(spec.name).ours)
      specs.push_back(std::move(spec));
  return specs;
}

void refuse_what_is_of_meshes(const contestants::Selectors& selectors) {
  if (!selectors.meshes.empty())
    throw std::invalid_argument(
        fmt::format("--mesh \"{}\" does not go with --bodies", selectors.meshes.front()));
  if (!selectors.trajectories.empty())
    throw std::invalid_argument(
        fmt::format("--trajectory \"{}\" does not go with --bodies", selectors.trajectories.front()));
}

std::vector<std::size_t> sizes_of(const ScaleBodiesOptions& options) {
  std::vector<std::size_t> sizes{1};
  const std::string text = !options.sizes.empty() ? options.sizes
                           : options.quick        ? quick_body_counts
                                                  : default_body_counts;
  for (const std::uint64_t size : scaling::parse_sizes(text, of_bodies))
    if (size > 1) sizes.push_back(size);
  return sizes;
}

int status_of(const std::vector<scaling::BodyRow>& rows, const contestants::Roster& roster) {
  int status = support::exit_done;
  for (const scaling::BodyRow& row : rows) {
    if (row.differing == 0 || roster.parse(row.contestant()).claimed != Guarantee::exact) continue;
    status = support::exit_check_failed;
    fmt::print(stderr, "touchmark: {} with {} bodies, motion={}: {} answers differ from those of the first\n",
               row.contestant(), row.bodies, row.motion, row.differing);
  }
  return status;
}

}  // namespace

int run_scale_bodies(const ProgramContext& context, const ScaleBodiesOptions& options) {
  refuse_what_is_of_meshes(options.selectors);
  const double limit_s =
      support::checked_positive("--limit-seconds", options.limit, support::Infinity::allowed);
  const std::vector<std::size_t> sizes = sizes_of(options);
  std::vector<contestants::ContestantSpec> contestants =
      contestants_of(options.selectors.detectors, context.roster);
  RunFrame frame(context, options.out);
  constexpr std::size_t rounds = 9, quick_rounds = 3;
  scaling::BodyRun run(context.roster, std::move(contestants), options.quick ? quick_rounds : rounds);
  std::vector<scaling::BodyRow> rows;
  std::vector<std::string> runs;
  const bool finished = frame.finishes([&] {
    for (const std::string motion : {"still", "one", "drift", "all"}) {
      for (const std::size_t size : sizes) {
        const std::vector<scaling::BodyRow> more =
            run.run(size, motion, limit_s, [&](const std::string& contestant) {
              frame.progress.show(fmt::format("field:{}:motion={}: {}", size, motion, contestant));
            });
        rows.insert(rows.end(), more.begin(), more.end());
        runs.push_back(results::run_json(frame.description, run.workload(), {}));
      }
    }
  });
  support::StandardOutput().write(scaling::bodies_table(rows));
  if (frame.folder && !runs.empty()) {
    frame.folder->write_file("bodies.csv", scaling::bodies_csv(rows));
    frame.folder->write_file("bodies_growth.csv", scaling::bodies_growth_csv(scaling::growth_of(rows)));
    frame.folder->write_file("run.json", results::joined_run_json(runs, finished));
  }
  if (!finished) return interrupted(rows.size());
  return status_of(rows, context.roster);
}

}  // namespace touchmark::bench::cli
