/// A mesh for the published algorithms: box tree and triangles, all in plain doubles without any certainty.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "bench/oracle/triangle_tree.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::proxies {

/// Returns the point of the triangle nearest to `point` (Ericson 2005, section 5.1.5).
Vec3 nearest_on_triangle(const Vec3& point, const oracle::Triangle& t);

class PlainMesh {
 public:
  explicit PlainMesh(const TriangleMesh& mesh) : mesh_(mesh), tree_(mesh_) {}

  struct Nearest {
    std::uint32_t triangle = 0;
    Vec3 point = Vec3::Zero();
    double distance = 0;
  };
  Nearest nearest(const Vec3& center);

  /// Calls visit(index, triangle) for every triangle whose box the segment comes as near as `radius`.
  template <class Visit>
  void near(const Vec3& from, const Vec3& to, double radius, Visit visit) {
    tree_.visit([&](const oracle::Box& box) { return oracle::distance_below(box, from, to); }, radius,
                [&](std::uint32_t index) {
                  const oracle::Triangle triangle = oracle::triangle_of(mesh_, index);
                  ++work_;
                  visit(index, triangle);
                });
  }

  void update(const TriangleMesh& mesh) {
    mesh_ = mesh;
    tree_ = oracle::TriangleTree(mesh_);
  }
  std::uint64_t work() const { return work_; }
  const TriangleMesh& mesh() const { return mesh_; }

 private:
  TriangleMesh mesh_;
  oracle::TriangleTree tree_;
  std::uint64_t work_ = 0;
};

/// The fraction at which the segment meets the triangle, from either side (Moller and Trumbore 1997).
std::optional<double> segment_meets(const Vec3& from, const Vec3& to, const oracle::Triangle& t);

}  // namespace touchmark::bench::proxies
