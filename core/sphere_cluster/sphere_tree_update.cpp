// The sampled distances: at first, later, and after the triangles moved.
#include <algorithm>
#include <cmath>

#include "core/sphere_cluster/sphere_tree.h"
#include "core/sphere_cluster/sphere_tree_search.h"
#include "core/sphere_cluster/tree_refit.h"

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

/// Of a box in the mesh's frame.
Aabb in_frame(const FilterFrame& frame, const Aabb& box) {
  return {frame.to_frame(box.min), frame.to_frame(box.max)};
}

}  // namespace

/// Where the hierarchy is a poor fit, the samples may cost no more than the hierarchy did.
std::uint64_t SphereTree::most_work_of_samples() const noexcept {
  constexpr std::uint64_t most_work_a_triangle = 1024;
  return most_work_a_triangle * parts_.triangles.size();
}

spheres::DistanceGrid::Interval SphereTree::sample(const Vec3& place, double most,
                                                   Sampling& sampling) const noexcept {
  constexpr spheres::DistanceGrid::Interval unknown{-1, -1};
  if (sampling.work.total() > sampling.most) return unknown;
  const Vec3 center = frame_.origin() + place / frame_.scale();
  const double reach = most / frame_.scale();
  RoughVisitor visitor{parts_, frame_, center, frame_.limit(reach * reach)};
  show(sampling.near, visitor);
  const float unseen = descend(frame_.point(center), visitor, sampling.most);
  sampling.work += visitor.work;
  if (unseen == spheres::gave_up) return unknown;
  sampling.near = visitor.kept_at;
  const double found = std::sqrt(visitor.squared) * frame_.scale();
  return {std::min<double>(std::sqrt(unseen), found), std::min(found, most)};
}

void SphereTree::fill_distances() {
  // Two roundings of a sample's place in the mesh's frame, measured in the tree's: of a mesh so far from 0
  // that they count, nothing is known beforehand.
  const double rounding =
      std::numeric_limits<double>::epsilon() * frame_.origin().lpNorm<1>() * frame_.scale();
  if (!(rounding < 0x1p-24)) return;
  const Aabb box = in_frame(frame_, bounds_);
  distances_ = spheres::DistanceGrid(box.min.cast<float>(), box.max.cast<float>(), parts_.triangles.size());
  if (samples_later_) return distances_.fill_later();
  Sampling sampling{most_work_of_samples()};
  distances_.fill([&](const Vec3& place, double most) { return sample(place, most, sampling); });
}

void SphereTree::refill_distances(const spheres::MovedTriangles& moved) {
  if (distances_.empty()) return;
  const Aabb box = in_frame(frame_, bounds_);
  if (2 * moved.count > parts_.triangles.size() ||
      !distances_.holds(box.min.cast<float>(), box.max.cast<float>()))
    return fill_distances();
  std::vector<Aabb> boxes;
  for (const Aabb& one : moved.boxes) boxes.push_back(in_frame(frame_, one));
  Sampling sampling{most_work_of_samples()};
  distances_.refill([&](const Vec3& place, double most) { return sample(place, most, sampling); },
                    [&](const Vec3& place, double most) {
                      return std::any_of(boxes.begin(), boxes.end(), [&](const Aabb& one) {
                        return one.squared_distance(place) <= most * most;
                      });
                    });
}

bool SphereTree::update(const TriangleMesh& mesh) {
  if (!searchable_ || !FilterFrame::fits(mesh.bounds()) || !frame_.widen(mesh.bounds())) return false;
  renew();
  bounds_ = mesh.bounds();
  radius_ = frame_.radius() * unit_;
  const spheres::MovedTriangles moved = spheres::refit_tree(parts_, mesh, frame_);
  if (moved.count == 0) return true;
  measure_grain();
  refill_distances(moved);
  return true;
}

}  // namespace touchmark
