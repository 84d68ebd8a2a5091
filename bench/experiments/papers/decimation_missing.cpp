#include "bench/experiments/papers/decimation.h"

namespace touchmark::bench::experiments::papers {

bool can_decimate() noexcept { return false; }

TriangleMesh decimate(const TriangleMesh&, std::size_t) {
  throw MeshError(
      "this build cannot decimate meshes: libopenmesh-dev was not installed; name one with --mesh");
}

}  // namespace touchmark::bench::experiments::papers
