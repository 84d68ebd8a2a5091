#include "bench/experiments/choose/choose_motions.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

#include "bench/workload/paced_workload.h"

namespace touchmark::bench::experiments::choose {
namespace {

constexpr const char* fast_slide = "fast-slide";
constexpr double faster = 10;

/// The slide with a tenth of the ticks on its way.
workload::Workload make_fast_slide(const std::string& mesh_name, const TriangleMesh& mesh,
                                   const workload::Selection& selection, workload::Ticks ticks) {
  ticks.rate_hz /= faster;
  workload::Workload slide = workload::workload_by_time(
      mesh_name, mesh, workload::selection_by_time(selection, mesh, "slide", ticks.rate_hz), "slide", ticks);
  slide.trajectories.front() = fast_slide;
  for (workload::Pace& pace : slide.motions) {
    pace.mean_speed *= faster;
    pace.max_speed *= faster;
  }
  return slide;
}

}  // namespace

workload::Workload workload_by_time(scenes::GeneratedScene scene, const workload::Selection& selection,
                                    const std::vector<std::string>& motions, double rate_hz) {
  if (std::ranges::find(motions, fast_slide) != motions.end())
    throw std::invalid_argument("fast-slide is over one mesh: over a scene of bodies write a motion file");
  return workload::scene_workload_by_time(std::move(scene), selection, motions, {rate_hz});
}

workload::Workload workload_by_time(const std::string& mesh_name, const TriangleMesh& mesh,
                                    const workload::Selection& selection,
                                    const std::vector<std::string>& motions, double rate_hz) {
  std::optional<workload::Workload> all;
  for (const std::string& motion : motions) {
    workload::Workload one =
        motion == fast_slide
            ? make_fast_slide(mesh_name, mesh, selection, {rate_hz})
            : workload::workload_by_time(mesh_name, mesh,
                                         workload::selection_by_time(selection, mesh, motion, rate_hz),
                                         motion, {rate_hz});
    if (!all) {
      all = std::move(one);
      continue;
    }
    std::ranges::move(one.trajectories, std::back_inserter(all->trajectories));
    std::ranges::move(one.traces, std::back_inserter(all->traces));
    std::ranges::move(one.motions, std::back_inserter(all->motions));
  }
  return *std::move(all);
}

}  // namespace touchmark::bench::experiments::choose
