/// The scene as a contestant's library keeps it: its answers may be right for that one, and wrong for the
/// mesh that was given only because storing it rounded.
#pragma once

#include <functional>
#include <vector>

#include "bench/contestant.h"
#include "bench/oracle/oracle.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench {

/// What storing makes of coordinates and lengths, in the mesh's frame and unit.
struct Storing {
  std::function<Vec3(const Vec3&)> point;
  std::function<double(double)> length;
};

/// Of numbers that are kept in single precision as scale * (point - origin).
Storing stored_in_single_precision(double scale, const Vec3& origin);

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
