/// What a worker's contestants are built of: one mesh, or a scene of bodies.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <variant>

#include "bench/contestants/roster.h"
#include "bench/workers/shapes_near.h"
#include "bench/workers/shared_workload.h"

namespace touchmark::bench::workers {

class Geometry {
 public:
  Geometry(std::span<const std::byte> input, const WorkloadLayout& layout) {
    if (layout.bodies > 0) {
      scenes::PlacedScene scene = read_scene(input, layout);
      scene.near = shapes_near(scene, read_traces(input, layout), read_schedules(input, layout));
      built_of_ = std::move(scene);
    } else {
      built_of_.emplace<TriangleMesh>(read_mesh(input, layout));
    }
  }

  /// Returns those of the mesh, or of all shapes that are ever near a probe.
  std::size_t triangles() const noexcept {
    if (const auto* const mesh = std::get_if<TriangleMesh>(&built_of_)) return mesh->size();
    std::size_t sum = 0;
    const auto& scene = std::get<scenes::PlacedScene>(built_of_);
    for (std::size_t i = 0; i < scene.shapes.size(); ++i)
      sum += scene.is_near(i) ? scene.shapes[i]->size() : 0;
    return sum;
  }
  std::unique_ptr<contestants::Contestant> build(const contestants::Roster& roster,
                                                 const contestants::ContestantSpec& spec) const {
    return std::visit([&](const auto& one) { return roster.build(spec, one); }, built_of_);
  }

 private:
  std::variant<scenes::PlacedScene, TriangleMesh> built_of_;
};

}  // namespace touchmark::bench::workers
