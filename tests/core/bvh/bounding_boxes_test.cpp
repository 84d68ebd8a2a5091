// The boxes of a hierarchy: which meshes get them, and that they hold what is below them.
#include "core/bvh/build/bounding_boxes.h"

#include <cstddef>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "bench/meshes/meshes.h"
#include "core/bvh/build/builder.h"

namespace touchmark::bvh {
namespace {

struct Tree {
  TriangleMesh mesh;
  FilterFrame frame;
  Parts parts;

  explicit Tree(const std::string& name)
      : mesh(bench::meshes::load_mesh(name)), frame(FilterFrame::around(mesh.bounds())) {
    parts = build_tree(mesh, nullptr, frame, 1);
  }
};

/// Returns how many corners below this node are outside the box of a child that they are below.
std::size_t corners_outside(const Tree& tree, std::uint32_t at) {
  const Node& node = tree.parts.nodes[at];
  std::size_t outside = 0;
  for (std::size_t i = 0; i < width; ++i) {
    if (node.is_empty(i)) continue;
    const Vec3 center(double{node.x()[i]}, double{node.y()[i]}, double{node.z()[i]});
    const Vec3 half(double{node.half_x()[i]}, double{node.half_y()[i]}, double{node.half_z()[i]});
    const auto check = [&](auto&& self, ChildRef child) -> void {
      if (!child.is_block()) {
        const Node& below = tree.parts.nodes[child.index()];
        for (std::size_t k = 0; k < width; ++k)
          if (!below.is_empty(k)) self(self, below.child[k]);
        return;
      }
      for (std::size_t k = 0; k < width; ++k) {
        const std::size_t slot = std::size_t{child.index()} * width + k;
        if (slot >= tree.parts.triangles.size()) break;
        for (const Vec3& corner : tree.parts.triangles[slot].corner)
          if (((tree.frame.to_frame(corner) - center).cwiseAbs() - half).maxCoeff() > 0) ++outside;
      }
    };
    check(check, node.child[i]);
  }
  return outside;
}

TEST(BoundingBoxes, HoldEveryTriangleBelowThem) {
  for (const char* name : {"fins:2000", "boxes:2000@offset=1e6", "truss:2000@scale=1e-6", "thin-plate"}) {
    const Tree tree(name);
    ASSERT_TRUE(tree.parts.boxes) << name;
    std::size_t outside = 0;
    for (std::uint32_t at = 0; at < tree.parts.nodes.size(); ++at) outside += corners_outside(tree, at);
    EXPECT_EQ(outside, 0U) << name;
  }
}

TEST(BoundingBoxes, AreForWhatFillsThem) {
  EXPECT_TRUE(Tree("voxels:2000").parts.boxes);
  EXPECT_TRUE(Tree("icosphere:4").parts.boxes);
  EXPECT_FALSE(Tree("spikes:4000").parts.boxes);
  EXPECT_FALSE(Tree("sliver-fan").parts.boxes);
}

}  // namespace
}  // namespace touchmark::bvh
