/// Meshes and trajectories of the cases, as plain numbers that a plug-in takes.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/regression/driver/cases.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::regression::driver {

struct Workload {
  TouchmarkGateMesh mesh = {};
  TouchmarkGatePass pass = {};
  std::uint64_t inputs = 0;  ///< a checksum of mesh and pass
};

/// Each mesh and each trajectory is made once.
class Workloads {
 public:
  /// False where its mesh is not installed.
  bool available(const Case& asked);
  /// The pointers stay good for as long as this object lives. The probe's radius and reach are 0.5 % of the
  /// diagonal.
  Workload of(const Case& asked);

 private:
  struct LoadedMesh {
    TriangleMesh mesh;
    std::vector<double> vertices;
    std::vector<std::uint32_t> triangles;
  };
  const LoadedMesh& mesh(const std::string& name);

  std::map<std::string, LoadedMesh> meshes_;
  std::map<std::pair<std::string, std::size_t>, std::vector<double>> centers_;
};

}  // namespace touchmark::bench::regression::driver
