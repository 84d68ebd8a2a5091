#include "bench/experiments/papers/paper_report.h"

#include <fmt/format.h>

#include "bench/results/build_info.h"
#include "bench/results/system_info.h"

namespace touchmark::bench::experiments::papers {

std::string report_machine() {
  const results::SystemInfo system = results::system_info();
  const results::BuildInfo& build = results::build_info();
  return fmt::format(
      "Measured {} on {} ({} cores, load {:.2f}), {} build by {}, commit {}. Times are of this machine; only "
      "their ratios carry over. Each is a median, in processor time, over rounds in which all detectors took "
      "turns, in random order, on the same steps.\n",
      system.date, system.cpu_model, system.cores, system.load_average[0], build.build_type, build.compiler,
      build.commit);
}

std::string report_setting(const PaperMesh& mesh) {
  return fmt::format("{}\nMesh: {}, {} triangles, box diagonal {:.6g} ({}).\n", report_machine(), mesh.name,
                     mesh.mesh.size(), mesh.mesh.diagonal(), mesh.origin);
}

}  // namespace touchmark::bench::experiments::papers
