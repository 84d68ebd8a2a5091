/// The scene as a contestant's library keeps it: its answers may be right for that one, and wrong for the
/// mesh that was given only because storing it rounded.
#pragma once

#include <vector>

#include "bench/contestants/storage_rounding.h"
#include "bench/oracle/oracle.h"
#include "bench/workload/steps.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench {

class StoredScene {
 public:
  /// Throws MeshError when what is left is no mesh.
  StoredScene(const TriangleMesh& mesh, Storing storing);

  const Oracle& oracle() const noexcept { return oracle_; }
  std::vector<Step> course(std::span<const Step> steps) const;

 private:
  Storing storing_;
  TriangleMesh mesh_;
  Oracle oracle_;
};

}  // namespace touchmark::bench
