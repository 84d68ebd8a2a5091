/// Builds the top of a hierarchy, and the parts below it when a query comes there.
#pragma once

#include <cstdint>
#include <optional>

#include "core/bvh/node.h"
#include "core/detector.h"
#include "core/search/plane_filter/plane_filter.h"
#include "core/triangle_mesh.h"

namespace touchmark::bvh {

/// Returns a tree of boxes whose parts are left to be built; nothing where the mesh is small. The same bits
/// with any number of threads.
std::optional<Parts> build_top(const TriangleMesh& mesh, const FilterFrame& frame, unsigned threads);

/// Returns the root of a part, which it builds if nobody did. It counts a look at each of the part's
/// triangles. Any thread may call it at any time; where another thread is just building the part, it waits.
[[gnu::noinline]] std::uint32_t built_part(const Parts& tree, std::uint32_t part, Work& work) noexcept;

/// Builds all parts that are left.
void build_rest(const Parts& tree, Work& work) noexcept;

}  // namespace touchmark::bvh
