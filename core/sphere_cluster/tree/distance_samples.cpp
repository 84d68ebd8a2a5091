// The sampled distances: at first, later, and after the triangles moved.
#include <algorithm>
#include <cmath>

#include "core/search/distance_field_filling.h"  // IWYU pragma: keep
#include "core/sphere_cluster/tree/cylinder_bvh.h"
#include "core/sphere_cluster/tree/refit.h"
#include "core/sphere_cluster/tree/search.h"  // IWYU pragma: keep

namespace touchmark {
namespace {

/// Is content with a triangle that is nearly nearest.
struct RoughVisitor {
  static constexpr double enough = 0.75;  ///< share of the squared distance

  const spheres::TreeParts& tree;
  const FilterFrame& frame;
  const Vec3& center;
  float limit;
  Work work{};
  double squared = std::numeric_limits<double>::infinity();
  Vec3 from_mesh = Vec3::Zero();
  std::uint32_t kept_at = std::numeric_limits<std::uint32_t>::max();

  bool accepts(std::uint32_t at) const noexcept { return at != kept_at; }
  void update(std::uint32_t at, const Offset& found) noexcept {
    if (!(found.squared < squared)) return;
    squared = found.squared;
    from_mesh = found.vector;
    kept_at = at;
    limit = std::min(limit, frame.limit(enough * squared));
  }
};

}  // namespace

DistanceField::Interval SphereTree::sample(const Vec3& position, double max_distance,
                                           Sampling& sampling) const noexcept {
  constexpr DistanceField::Interval unknown{-1, -1};
  if (sampling.work.total() > sampling.budget) return unknown;
  const Vec3 center = frame_.from_frame(position);
  const double reach = max_distance / frame_.scale();
  RoughVisitor visitor{parts_, frame_, center, frame_.limit(reach * reach)};
  visit(sampling.near, visitor);
  const FilterPoint point = frame_.point(center);
  const std::uint64_t budget = remaining(sampling.budget, sampling.work.total());
  const float unseen = traverse(point, visitor, budget);
  sampling.work += visitor.work;
  if (unseen == spheres::exhausted) return unknown;
  sampling.near = visitor.kept_at;
  sampling.to_mesh = -frame_.scale() * visitor.from_mesh;
  const double found = std::sqrt(visitor.squared) * frame_.scale();
  return {std::min<double>(std::sqrt(unseen), found), std::min(found, max_distance)};
}

class SphereTree::Sampler {
 public:
  Sampler(const SphereTree& tree, std::uint64_t budget, std::uint32_t near) noexcept
      : tree_(tree), sampling_{budget, near} {}

  DistanceField::Interval operator()(const Vec3& position, double max_distance) noexcept {
    return tree_.sample(position, max_distance, sampling_);
  }
  std::uint32_t near() const noexcept { return sampling_.near; }
  double distance_to(std::uint32_t near, const Vec3& position) noexcept {
    sampling_.near = near;
    const Vec3 center = tree_.frame_.from_frame(position);
    RoughVisitor visitor{tree_.parts_, tree_.frame_, center, spheres::farthest};
    tree_.visit(near, visitor);
    sampling_.work += visitor.work;
    sampling_.to_mesh = -tree_.frame_.scale() * visitor.from_mesh;
    return std::sqrt(visitor.squared) * tree_.frame_.scale();
  }
  const Vec3& to_mesh() const noexcept { return sampling_.to_mesh; }
  const Work& work() const noexcept { return sampling_.work; }

 private:
  const SphereTree& tree_;
  Sampling sampling_;
};

/// Rejects once the point has its samples, two at most, which take no more than half of the work that a query
/// may take before it looks at every triangle. `budget` is what is left of that.
bool SphereTree::rejects_once_sampled(const FilterPoint& point, const Vec3& center, double reach,
                                      Memory& memory, std::uint64_t& budget, Work& work) const noexcept {
  // With a reach as long as the mesh no sample helps.
  if (!(reach < radius_)) return false;
  Sampler distance_at(*this, work_limit() / 2, memory.slot);
  bool is_known_far = false;
  while (!is_known_far && distances_.sample_near(point, distance_at))
    is_known_far = rejects_by_distance_field(point, center, reach, memory);
  work += distance_at.work();
  budget = remaining(budget, distance_at.work().total());
  return is_known_far;
}

/// Returns what makes a function that takes samples one after the other, near the last one, with its share of
/// the work that all may be.
auto SphereTree::sampler() const noexcept {
  const auto all = static_cast<double>(DistanceField::max_work(parts_.triangles.size()));
  return [this, all](double share) { return Sampler(*this, static_cast<std::uint64_t>(share * all), 0); };
}

void SphereTree::fill_distances() {
  distances_ = DistanceField::around(frame_, bounds_, parts_.triangles.size());
  if (lazy_) return distances_.fill_lazily();
  distances_.fill(sampler(), threads_);
}

void SphereTree::refill_distances(const spheres::MovedTriangles& moved) {
  if (distances_.empty()) return;
  if (2 * moved.count > parts_.triangles.size() || !distances_.holds(frame_, bounds_))
    return fill_distances();
  std::vector<Aabb> boxes;
  for (const Aabb& one : moved.boxes) boxes.push_back(frame_.to_frame(one));
  distances_.refill(sampler(), boxes, threads_);
}

bool SphereTree::update(const TriangleMesh& mesh) {
  if (!parts_.unbuilt.empty()) return false;  // it is built anew in less time than all of it moves
  if (!searchable_ || !FilterFrame::fits(mesh.bounds()) || !frame_.widen(mesh.bounds())) return false;
  epoch_ = Epoch::next();
  bounds_ = mesh.bounds();
  measure_box();
  const spheres::MovedTriangles moved = spheres::refit_tree(parts_, mesh, frame_);
  if (moved.count == 0) return true;
  measure_leaves();
  refill_distances(moved);
  return true;
}

}  // namespace touchmark
