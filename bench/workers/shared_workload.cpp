#include "bench/workers/shared_workload.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <new>

namespace touchmark::bench::workers {
namespace {

constexpr std::size_t doubles_a_step = 5;  // centre, radius, reach

/// Writes or reads values one after the other.
class Cursor {
 public:
  explicit Cursor(std::byte* at) : at_(at) {}
  template <class Value>
  void put(Value value) noexcept {
    std::memcpy(at_, &value, sizeof value);
    at_ += sizeof value;
  }
  void put(const Vec3& v) noexcept {
    for (int axis = 0; axis < 3; ++axis) put(v[axis]);
  }

 private:
  std::byte* at_;
};

class Reader {
 public:
  explicit Reader(const std::byte* at) : at_(at) {}
  template <class Value>
  Value get() noexcept {
    Value value;
    std::memcpy(&value, at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  Vec3 get_vec3() noexcept {
    const auto x = get<double>(), y = get<double>(), z = get<double>();
    return {x, y, z};
  }

 private:
  const std::byte* at_;
};

std::size_t mesh_bytes(std::size_t vertices, std::size_t triangles, std::size_t ids) noexcept {
  return vertices * 3 * sizeof(double) + triangles * 3 * sizeof(std::uint32_t) + ids * sizeof(TriangleId);
}

/// Returns the bytes of the mesh, or of all shapes.
std::size_t mesh_bytes(const WorkloadLayout& layout) noexcept {
  std::size_t bytes = mesh_bytes(layout.vertices, layout.triangles, layout.ids);
  for (const auto& [vertices, triangles, ids] : layout.shapes) bytes += mesh_bytes(vertices, triangles, ids);
  return bytes;
}

std::size_t step_bytes(const WorkloadLayout& layout) noexcept {
  std::size_t bytes = 0;
  for (const std::size_t steps : layout.trace_steps) bytes += steps * doubles_a_step * sizeof(double);
  return bytes;
}

/// Returns where the bodies begin. They and the schedules are numbers of eight bytes, and are read where they
/// lie.
std::size_t bodies_begin(const WorkloadLayout& layout) noexcept {
  constexpr std::size_t aligned = alignof(scenes::BodyMove);
  return (mesh_bytes(layout) + step_bytes(layout) + aligned - 1) / aligned * aligned;
}

/// A body is its shape, that one's radius where it is round, and the body's pose at the start.
constexpr std::size_t bytes_a_body = sizeof(std::uint64_t) + sizeof(double) + sizeof(scenes::BodyMove);

std::size_t schedule_bytes(const WorkloadLayout& layout, std::size_t trace) noexcept {
  if (layout.trace_moves[trace] == 0) return 0;
  return (layout.trace_steps[trace] + 1) * sizeof(std::uint64_t) +
         layout.trace_moves[trace] * sizeof(scenes::BodyMove);
}

void put_mesh(Cursor& cursor, const TriangleMesh& mesh) noexcept {
  for (const Vec3& vertex : mesh.vertices()) cursor.put(vertex);
  for (const TriangleMesh::Corners& corners : mesh.triangles()) cursor.put(corners);
  for (const TriangleId id : mesh.ids()) cursor.put(id);
}

void put_scene(Cursor& cursor, const scenes::PlacedScene& scene, const workload::Workload& workload) {
  for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
    cursor.put(std::uint64_t{scene.bodies[i].shape});
    cursor.put(scene.radius_of(scene.bodies[i].shape));
    cursor.put(scenes::BodyMove::of(i, scene.bodies[i].start));
  }
  for (const scenes::Schedule& schedule : workload.schedules) {
    if (schedule.moves.empty()) continue;
    for (const std::uint64_t first : schedule.first) cursor.put(first);
    for (const scenes::BodyMove& move : schedule.moves) cursor.put(move);
  }
}

TriangleMesh get_mesh(Reader& reader, std::size_t vertex_count, std::size_t triangle_count,
                      std::size_t id_count) {
  std::vector<Vec3> vertices(vertex_count);
  for (Vec3& vertex : vertices) vertex = reader.get_vec3();
  std::vector<TriangleMesh::Corners> triangles(triangle_count);
  for (TriangleMesh::Corners& corners : triangles) corners = reader.get<TriangleMesh::Corners>();
  std::vector<TriangleId> ids(id_count);
  for (TriangleId& id : ids) id = reader.get<TriangleId>();
  return {std::move(vertices), std::move(triangles), std::move(ids)};
}

}  // namespace

std::size_t WorkloadLayout::input_bytes() const noexcept {
  std::size_t bytes = bodies_begin(*this) + bodies * bytes_a_body;
  for (std::size_t trace = 0; trace < trace_moves.size(); ++trace) bytes += schedule_bytes(*this, trace);
  return bytes;
}

std::size_t WorkloadLayout::output_steps() const noexcept {
  std::size_t longest = min_output_steps;
  for (const std::size_t steps : trace_steps) longest = std::max(longest, steps);
  return longest;
}

std::size_t OutputBuffers::bytes_for(std::size_t steps) noexcept {
  return steps * (sizeof(workload::Answer) + 2 * sizeof(std::uint64_t));
}

OutputBuffers::OutputBuffers(std::span<std::byte> bytes, std::size_t steps) {
  assert(bytes.size() >= bytes_for(steps));
  // All are plain bytes (see answer.h), and the mapping is page-aligned.
  auto* answers = reinterpret_cast<workload::Answer*>(bytes.data());
  answers_ = {answers, steps};
  work_ = {reinterpret_cast<std::uint64_t*>(bytes.data() + steps * sizeof(workload::Answer)), steps};
  prepare_ticks_ = {work_.data() + steps, steps};
  tick_records_ = {reinterpret_cast<TickRecord*>(bytes.data()), steps};
}

WorkloadLayout layout_of(const workload::Workload& workload, std::size_t min_output_steps) {
  WorkloadLayout layout;
  layout.min_output_steps = min_output_steps;
  for (const std::vector<workload::Step>& trace : workload.traces) layout.trace_steps.push_back(trace.size());
  if (!workload.scene) {
    const TriangleMesh& mesh = workload.mesh;
    layout.vertices = mesh.vertices().size();
    layout.triangles = mesh.size();
    layout.ids = mesh.ids().size();
    return layout;
  }
  for (const auto& shape : placed(*workload.scene).shapes)
    layout.shapes.push_back({shape->vertices().size(), shape->size(), shape->ids().size()});
  layout.bodies = workload.scene->bodies.size();
  for (const scenes::Schedule& schedule : workload.schedules)
    layout.trace_moves.push_back(schedule.moves.size());
  return layout;
}

SharedMemory write_input(const workload::Workload& workload) {
  const WorkloadLayout layout = layout_of(workload);
  SharedMemory memory = SharedMemory::create(layout.input_bytes());
  Cursor cursor(memory.bytes().data());
  scenes::PlacedScene scene;
  if (workload.scene) {
    scene = placed(*workload.scene);
    for (const auto& shape : scene.shapes) put_mesh(cursor, *shape);
  } else {
    put_mesh(cursor, workload.mesh);
  }
  for (const std::vector<workload::Step>& trace : workload.traces) {
    for (const workload::Step& step : trace) {
      cursor.put(step.probe.center);
      cursor.put(step.probe.radius);
      cursor.put(step.reach);
    }
  }
  if (workload.scene) {
    Cursor after(memory.bytes().data() + bodies_begin(layout));
    put_scene(after, scene, workload);
  }
  return memory;
}

TriangleMesh read_mesh(std::span<const std::byte> input, const WorkloadLayout& layout) {
  Reader reader(input.data());
  return get_mesh(reader, layout.vertices, layout.triangles, layout.ids);
}

scenes::PlacedScene read_scene(std::span<const std::byte> input, const WorkloadLayout& layout) {
  scenes::PlacedScene scene;
  Reader reader(input.data());
  for (const auto& [vertices, triangles, ids] : layout.shapes)
    scene.shapes.push_back(std::make_shared<const TriangleMesh>(get_mesh(reader, vertices, triangles, ids)));
  Reader placed(input.data() + bodies_begin(layout));
  for (std::size_t i = 0; i < layout.bodies; ++i) {
    const auto shape = static_cast<std::uint32_t>(placed.get<std::uint64_t>());
    if (const auto radius = placed.get<double>(); radius > 0) {
      scene.radii.resize(scene.shapes.size());
      scene.radii[shape] = radius;
    }
    scene.bodies.push_back({shape, placed.get<scenes::BodyMove>().pose()});
  }
  scene.moves = std::ranges::any_of(layout.trace_moves, [](std::size_t moves) { return moves > 0; });
  return scene;
}

std::vector<scenes::ScheduleView> read_schedules(std::span<const std::byte> input,
                                                 const WorkloadLayout& layout) {
  std::vector<scenes::ScheduleView> schedules(layout.trace_steps.size());
  const std::byte* at = input.data() + bodies_begin(layout) + layout.bodies * bytes_a_body;
  for (std::size_t trace = 0; trace < layout.trace_moves.size(); ++trace) {
    if (layout.trace_moves[trace] == 0) continue;
    // The mapping is page-aligned, and all before is in numbers of eight bytes.
    const std::size_t firsts = layout.trace_steps[trace] + 1;
    schedules[trace].first = {reinterpret_cast<const std::uint64_t*>(at), firsts};
    at += firsts * sizeof(std::uint64_t);
    schedules[trace].moves = {reinterpret_cast<const scenes::BodyMove*>(at), layout.trace_moves[trace]};
    at += layout.trace_moves[trace] * sizeof(scenes::BodyMove);
  }
  return schedules;
}

std::vector<std::vector<workload::Step>> read_traces(std::span<const std::byte> input,
                                                     const WorkloadLayout& layout) {
  Reader reader(input.data() + mesh_bytes(layout));
  std::vector<std::vector<workload::Step>> traces;
  for (const std::size_t steps : layout.trace_steps) {
    std::vector<workload::Step>& trace = traces.emplace_back(steps);
    for (workload::Step& step : trace) {
      step.probe.center = reader.get_vec3();
      step.probe.radius = reader.get<double>();
      step.reach = reader.get<double>();
    }
  }
  return traces;
}

}  // namespace touchmark::bench::workers
