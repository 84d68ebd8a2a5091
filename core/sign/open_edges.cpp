#include "core/sign/open_edges.h"

#include <cstdlib>

namespace touchmark::sign {

OpenEdges open_edges(const IndexedTriangles& welded, const EdgeMap<3>& edges) {
  OpenEdges open;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [from, to] = edges.ends(e);
    std::ptrdiff_t forward = 0;
    for (const std::uint32_t side : edges.sides(e))
      forward += welded.faces[side / 3][side % 3] == from ? 1 : -1;
    if (forward == 0) continue;
    if (std::abs(forward) > 1) ++open.contrary;
    if (forward == 1) open.edges.push_back({from, to});
    if (forward == -1) open.edges.push_back({to, from});
  }
  return open;
}

}  // namespace touchmark::sign
