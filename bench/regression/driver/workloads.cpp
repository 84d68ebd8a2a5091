#include "bench/regression/driver/workloads.h"

#include <algorithm>
#include <bit>

#include "bench/meshes/meshes.h"
#include "bench/trajectories/trajectories.h"

namespace touchmark::bench::regression::driver {
namespace {

constexpr double radius_of_diagonal = 0.005;

std::vector<double> flat(std::span<const Vec3> points) {
  std::vector<double> numbers;
  numbers.reserve(3 * points.size());
  for (const Vec3& p : points) numbers.insert(numbers.end(), {p.x(), p.y(), p.z()});
  return numbers;
}

/// FNV-1a, a word at a time.
class Fingerprint {
 public:
  void add(std::uint64_t word) noexcept { value_ = (value_ ^ word) * 0x100000001b3ULL; }
  void add(const double* numbers, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) add(std::bit_cast<std::uint64_t>(numbers[i]));
  }
  std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

std::uint64_t fingerprint(const Workload& workload) {
  Fingerprint print;
  print.add(workload.mesh.vertices, 3 * workload.mesh.vertex_count);
  for (std::size_t i = 0; i < 3 * workload.mesh.triangle_count; ++i) print.add(workload.mesh.triangles[i]);
  print.add(workload.pass.centers, 3 * workload.pass.count);
  print.add(&workload.pass.radius, 1);
  print.add(&workload.pass.reach, 1);
  return print.value();
}

}  // namespace

bool Workloads::available(const Case& asked) {
  if (!asked.needs_file()) return true;
  const std::vector<meshes::NamedMesh> known = meshes::named_meshes();
  return std::ranges::any_of(
      known, [&](const meshes::NamedMesh& info) { return info.name == asked.mesh && info.available; });
}

const Workloads::LoadedMesh& Workloads::mesh(const std::string& name) {
  const auto found = meshes_.find(name);
  if (found != meshes_.end()) return found->second;
  TriangleMesh mesh = meshes::load_mesh(name);
  std::vector<double> vertices = flat(mesh.vertices());
  std::vector<std::uint32_t> triangles;
  triangles.reserve(3 * mesh.size());
  for (const TriangleMesh::Corners& corners : mesh.triangles())
    triangles.insert(triangles.end(), corners.begin(), corners.end());
  return meshes_.emplace(name, LoadedMesh{std::move(mesh), std::move(vertices), std::move(triangles)})
      .first->second;
}

Workload Workloads::of(const Case& asked) {
  const LoadedMesh& loaded = this->mesh(asked.mesh);
  const double radius = radius_of_diagonal * loaded.mesh.diagonal();
  std::vector<double>& centers = centers_[{asked.mesh + std::string(1, '/') + asked.trajectory, asked.steps}];
  if (centers.empty())
    centers = flat(
        trajectories::make_trajectory(asked.trajectory, loaded.mesh, {asked.steps, 1, radius}).positions);
  Workload workload;
  workload.mesh = {loaded.vertices.data(), loaded.vertices.size() / 3, loaded.triangles.data(),
                   loaded.triangles.size() / 3};
  workload.pass = {asked.query, centers.data(), centers.size() / 3, radius, radius};
  workload.inputs = fingerprint(workload);
  return workload;
}

}  // namespace touchmark::bench::regression::driver
