#include "core/grid_group/direct_grid.h"

namespace touchmark::grid {

DirectGrid DirectGrid::build(const TriangleMesh& mesh, const DirectOptions&) {
  DirectGrid grid;
  grid.bounds_ = mesh.bounds();
  grid.store_ = TriangleStore::build(mesh);
  grid.tree_ = BoxTree(grid.store_);
  return grid;
}

}  // namespace touchmark::grid
