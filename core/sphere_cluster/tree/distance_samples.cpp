// The sampled distances: at first, later, and after the triangles moved.
#include <algorithm>
#include <cmath>

#include "core/sphere_cluster/tree/cylinder_bvh.h"
#include "core/sphere_cluster/tree/refit.h"
#include "core/sphere_cluster/tree/search.h"

namespace touchmark {
namespace {

/// Is content with a triangle that is nearly nearest.
struct RoughVisitor {
  static constexpr double enough = 0.64;  ///< of the squared distance

  const spheres::TreeParts& tree;
  const FilterFrame& frame;
  const Vec3& center;
  float limit;
  Work work{};
  double squared = std::numeric_limits<double>::infinity();
  std::uint32_t kept_at = std::numeric_limits<std::uint32_t>::max();

  bool wants(std::uint32_t at) const noexcept { return at != kept_at; }
  void take(std::uint32_t at, const Offset& found) noexcept {
    if (!(found.squared < squared)) return;
    squared = found.squared;
    kept_at = at;
    limit = std::min(limit, frame.limit(enough * squared));
  }
};

}  // namespace

DistanceGrid::Interval SphereTree::sample(const Vec3& place, double most, Sampling& sampling) const noexcept {
  constexpr DistanceGrid::Interval unknown{-1, -1};
  if (sampling.work.total() > sampling.most) return unknown;
  const Vec3 center = frame_.from_frame(place);
  const double reach = most / frame_.scale();
  RoughVisitor visitor{parts_, frame_, center, frame_.limit(reach * reach)};
  show(sampling.near, visitor);
  const float unseen = descend(frame_.point(center), visitor, left_of(sampling.most, sampling.work.total()));
  sampling.work += visitor.work;
  if (unseen == spheres::gave_up) return unknown;
  sampling.near = visitor.kept_at;
  const double found = std::sqrt(visitor.squared) * frame_.scale();
  return {std::min<double>(std::sqrt(unseen), found), std::min(found, most)};
}

void SphereTree::fill_distances() {
  distances_ = DistanceGrid::around(frame_, bounds_, parts_.triangles.size());
  if (samples_later_) return distances_.fill_later();
  Sampling sampling{DistanceGrid::most_work(parts_.triangles.size())};
  distances_.fill([&](const Vec3& place, double most) { return sample(place, most, sampling); });
}

void SphereTree::refill_distances(const spheres::MovedTriangles& moved) {
  if (distances_.empty()) return;
  if (2 * moved.count > parts_.triangles.size() || !distances_.holds(frame_, bounds_))
    return fill_distances();
  std::vector<Aabb> boxes;
  for (const Aabb& one : moved.boxes) boxes.push_back(frame_.to_frame(one));
  Sampling sampling{DistanceGrid::most_work(parts_.triangles.size())};
  distances_.refill([&](const Vec3& place, double most) { return sample(place, most, sampling); }, boxes);
}

bool SphereTree::update(const TriangleMesh& mesh) {
  if (!searchable_ || !FilterFrame::fits(mesh.bounds()) || !frame_.widen(mesh.bounds())) return false;
  renew();
  bounds_ = mesh.bounds();
  radius_ = frame_.radius() * frame_.unit();
  const spheres::MovedTriangles moved = spheres::refit_tree(parts_, mesh, frame_);
  if (moved.count == 0) return true;
  measure_grain();
  refill_distances(moved);
  return true;
}

}  // namespace touchmark
