#include "bench/ground_truth/workload_truths.h"

#include "bench/ground_truth/scene_truths.h"

namespace touchmark::bench::ground_truth {

WorkloadTruths::WorkloadTruths(const workload::Workload& workload) : workload_(workload) {
  if (workload.scene) {
    scene_ = placed(*workload.scene);
    scene_oracle_.emplace(scene_oracle(scene_));
  } else {
    oracle_.emplace(workload.mesh);
  }
}

std::unique_ptr<TraceTruths> WorkloadTruths::of(std::size_t trace) {
  if (oracle_) return std::make_unique<GroundTruths>(*oracle_, workload_.traces[trace]);
  return std::make_unique<SceneTruths>(*scene_oracle_, scene_, workload_.schedules[trace].view(),
                                       workload_.traces[trace]);
}

}  // namespace touchmark::bench::ground_truth
