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

std::size_t mesh_bytes(const WorkloadLayout& layout) noexcept {
  return layout.vertices * 3 * sizeof(double) + layout.triangles * 3 * sizeof(std::uint32_t) +
         layout.ids * sizeof(TriangleId);
}

}  // namespace

std::size_t WorkloadLayout::input_bytes() const noexcept {
  std::size_t bytes = mesh_bytes(*this);
  for (const std::size_t steps : trace_steps) bytes += steps * doubles_a_step * sizeof(double);
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

WorkloadLayout layout_of(const TriangleMesh& mesh, const std::vector<std::vector<workload::Step>>& traces,
                         std::size_t min_output_steps) {
  WorkloadLayout layout{mesh.vertices().size(), mesh.size(), mesh.ids().size(), {}, min_output_steps};
  for (const std::vector<workload::Step>& trace : traces) layout.trace_steps.push_back(trace.size());
  return layout;
}

SharedMemory write_input(const TriangleMesh& mesh, const std::vector<std::vector<workload::Step>>& traces) {
  SharedMemory memory = SharedMemory::create(layout_of(mesh, traces).input_bytes());
  Cursor cursor(memory.bytes().data());
  for (const Vec3& vertex : mesh.vertices()) cursor.put(vertex);
  for (const TriangleMesh::Corners& corners : mesh.triangles()) cursor.put(corners);
  for (const TriangleId id : mesh.ids()) cursor.put(id);
  for (const std::vector<workload::Step>& trace : traces) {
    for (const workload::Step& step : trace) {
      cursor.put(step.probe.center);
      cursor.put(step.probe.radius);
      cursor.put(step.reach);
    }
  }
  return memory;
}

TriangleMesh read_mesh(std::span<const std::byte> input, const WorkloadLayout& layout) {
  Reader reader(input.data());
  std::vector<Vec3> vertices(layout.vertices);
  for (Vec3& vertex : vertices) vertex = reader.get_vec3();
  std::vector<TriangleMesh::Corners> triangles(layout.triangles);
  for (TriangleMesh::Corners& corners : triangles) corners = reader.get<TriangleMesh::Corners>();
  std::vector<TriangleId> ids(layout.ids);
  for (TriangleId& id : ids) id = reader.get<TriangleId>();
  return {std::move(vertices), std::move(triangles), std::move(ids)};
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
