/// The mesh as a contestant's library keeps it: its answers may be right for that one, and wrong for the
/// mesh that was given only because storing it rounded.
#pragma once

#include <vector>

#include "bench/contestants/storage_rounding.h"
#include "bench/oracle/oracle.h"
#include "bench/workload/steps.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::ground_truth {

class RoundedMesh {
 public:
  /// Throws MeshError when what is left is no mesh.
  RoundedMesh(const TriangleMesh& mesh, contestants::StorageRounding storage_rounding);

  const oracle::Oracle& oracle() const noexcept { return oracle_; }
  std::vector<workload::Step> trace(std::span<const workload::Step> steps) const;

 private:
  contestants::StorageRounding storage_rounding_;
  TriangleMesh mesh_;
  oracle::Oracle oracle_;
};

}  // namespace touchmark::bench::ground_truth
