#include "bench/cli/step_outputs.h"

#include <string_view>

#include "bench/results/steps_csv.h"
#include "bench/results/steps_file.h"

namespace touchmark::bench::cli {

StepOutputs::StepOutputs(const results::ResultsFolder* folder, const std::string& csv_path)
    : folder_(folder) {
  if (!csv_path.empty()) csv_.emplace(csv_path);
  if (folder_ == nullptr) return;
  folder_->remove(results::steps_file_name);
  folder_->remove("visited.json");  // what scripts/report --visits wrote of an earlier run
}

void StepOutputs::write(const std::string& run_id, const workload::Workload& workload,
                        const measurement::Comparison& comparison,
                        const std::vector<measurement::ResultRow>& rows) {
  // A page replays one mesh that stands; bodies that move it does not draw.
  if (folder_ != nullptr && !workload.scene) {
    std::vector<std::vector<ground_truth::StepTruth>> truths;
    for (std::size_t trace = 0; trace < workload.traces.size(); ++trace)
      truths.push_back(comparison.truths(trace));
    folder_->write_file(results::steps_file_name, results::steps_file(run_id, workload, rows, truths));
  }
  if (!csv_) return;
  results::write_steps_csv(rows, [this](std::string_view text) { csv_->write(text); });
  csv_->commit();
  csv_.reset();
}

}  // namespace touchmark::bench::cli
