/// The mesh and the traces, written once by the program and read by every worker, and the output buffers that
/// workers answer into. Only one worker works at a time, so they share these.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bench/contestants/contestant.h"
#include "bench/scenes/schedule.h"
#include "bench/workers/shared_memory.h"
#include "bench/workers/timing/paced_replay.h"
#include "bench/workload/answer.h"
#include "bench/workload/workload.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::workers {

/// The sizes of what lies one after the other in the input: vertices, corners, ids, then each trace's steps.
/// A scene has each shape's vertices, corners and ids; then, after the steps, the bodies, and each
/// trace's schedule.
struct WorkloadLayout {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t ids = 0;
  std::vector<std::size_t> trace_steps;
  std::vector<std::array<std::size_t, 3>> shapes;  ///< vertices, triangles and ids of each of a scene
  std::size_t bodies = 0;                          ///< how many a scene has; 0: it is a mesh
  std::vector<std::size_t> trace_moves;            ///< one a trace of a scene; 0: nothing moves
  std::size_t min_output_steps = 0;                ///< the output has room for more than the longest trace

  std::size_t input_bytes() const noexcept;
  /// How many steps the output has room for.
  std::size_t output_steps() const noexcept;
};

/// Holds one request's results. Answers and work, two kinds of ticks, or records of a paced loop's ticks: a
/// step needs one of these.
class OutputBuffers {
 public:
  static std::size_t bytes_for(std::size_t steps) noexcept;
  OutputBuffers(std::span<std::byte> bytes, std::size_t steps);

  std::span<workload::Answer> answers(std::size_t steps) const noexcept { return answers_.first(steps); }
  std::span<std::uint64_t> work(std::size_t steps) const noexcept { return work_.first(steps); }
  std::span<std::uint64_t> ticks(std::size_t steps) const noexcept { return work_.first(steps); }
  std::span<std::uint64_t> prepare_ticks(std::size_t steps) const noexcept {
    return prepare_ticks_.first(steps);
  }
  /// They lie where the answers do.
  std::span<TickRecord> tick_records(std::size_t ticks) const noexcept { return tick_records_.first(ticks); }

 private:
  std::span<workload::Answer> answers_;
  std::span<std::uint64_t> work_;
  std::span<std::uint64_t> prepare_ticks_;
  std::span<TickRecord> tick_records_;
};

/// The program's side: fills the input. Throws ResourceError when memory is short.
SharedMemory write_input(const workload::Workload& workload);
WorkloadLayout layout_of(const workload::Workload& workload, std::size_t min_output_steps = 0);

/// The worker's side. read_mesh is of a workload without a scene, read_scene and read_schedules of one with
/// a scene; the schedules lie where the input does.
scenes::PlacedScene read_scene(std::span<const std::byte> input, const WorkloadLayout& layout);
std::vector<scenes::ScheduleView> read_schedules(std::span<const std::byte> input,
                                                 const WorkloadLayout& layout);
TriangleMesh read_mesh(std::span<const std::byte> input, const WorkloadLayout& layout);
std::vector<std::vector<workload::Step>> read_traces(std::span<const std::byte> input,
                                                     const WorkloadLayout& layout);

}  // namespace touchmark::bench::workers
