// The search for the nearest triangle within a budget of work. It is compiled by itself: nothing of it is
// inlined beside the searches without a budget.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/point_queries/nearest_search.h"

namespace touchmark::queries {
namespace {

struct BracketVisitor : NearestVisitor {
  using NearestVisitor::NearestVisitor;
  float left = 0;  ///< bounds the distance, squared, to what an exhausted search did not show
};

class BracketSearch {
 public:
  BracketSearch(const Surface& surface, const Vec3& center, double reach, PointMemory& memory, Work& work,
                std::uint64_t budget) noexcept
      : surface_(surface),
        center_(center),
        reach_(reach),
        memory_(memory),
        work_(work),
        budget_(std::min(budget, max_nearest_work(surface.bvh))) {}

  Bracket run() noexcept {
    const WideBvh& bvh = surface_.bvh;
    const auto search = [this] { return searched(); };
    Bracket bracket;
    if (memory_.is_kept && memory_.epoch == bvh.epoch())
      bracket.contact = bvh::with_isa(bvh.simd(), [&](auto isa) {
        return isa.nearest_kept(bvh.frame(), bvh.parts().triangles.data(), center_, reach_, memory_, work_,
                                search);
      });
    else
      bracket.contact = search();
    bracket.is_nearest = !is_open_;
    bracket.lower = is_open_ ? memory_.lower : bracket.contact ? bracket.contact->distance : reach_;
    return bracket;
  }

 private:
  std::optional<Contact> searched() noexcept {
    const WideBvh& bvh = surface_.bvh;
    const bool has_kept = memory_.is_kept && memory_.epoch == bvh.epoch();
    memory_.is_kept = false;
    memory_.claim(bvh.epoch());
    const FilterPoint point = bvh.frame().point(center_);
    if (!bvh.can_search(point)) return nearest_of_every(bvh, center_, reach_, work_);
    const double error = bvh.frame().kernel_error(point.plane_error);
    BracketVisitor visitor(bvh.parts(), bvh.frame(), center_,
                           bvh.frame().limit((reach_ + error) * (reach_ + error)), error);
    if (has_kept && search_around(bvh, reach_, error, visitor, memory_, budget_)) {
      work_ += visitor.work;
      ++memory_.around.answered;
      keep_nearest(bvh, memory_);
      return finished(visitor, point, error, std::min(root(visitor), reach_));
    }
    if (rejects_by_distance_field(bvh, point, center_, reach_, memory_)) {
      work_ += visitor.work;
      return std::nullopt;
    }
    if (memory_.is_near() || !bvh.is_lazy()) bvh::visit(bvh, memory_.slot, visitor);
    const double farthest = sampled_distance(bvh, point);
    visitor.limit = std::min(visitor.limit, bvh.frame().limit((farthest + error) * (farthest + error)));
    float unseen = bvh::exhausted;
    // Of a hierarchy that is not yet built the first search goes on until it has found a triangle.
    for (std::uint64_t more = budget_; unseen == bvh::exhausted; more = 2 * more + bvh::width) {
      unseen = bvh::traverse(bvh, point, visitor, visitor.work.spheres + visitor.work.triangles + more);
      if (visitor.candidates.found()) break;
    }
    work_ += visitor.work;
    if (unseen == bvh::exhausted) return unfinished(visitor, point);
    return finished(visitor, point, error, std::sqrt(bvh.frame().squared(unseen)));
  }

  static double root(const BracketVisitor& visitor) noexcept {
    return std::sqrt(visitor.candidates.best().squared_distance);
  }

  void remember(const BracketVisitor& visitor, const FilterPoint& point, double unseen) noexcept {
    memory_.move = center_ - memory_.center;
    memory_.center = center_;
    memory_.upper = root(visitor);
    memory_.lower = std::min(unseen, memory_.upper * (1 - 0x1p-40)) - clearance_pad(surface_.bvh, point);
    if (visitor.candidates.found()) memory_.slot = visitor.candidates.at();
  }

  std::optional<Contact> finished(const BracketVisitor& visitor, const FilterPoint& point, double error,
                                  double unseen) noexcept {
    remember(visitor, point, unseen);
    if (!visitor.candidates.found()) return std::nullopt;
    if (!memory_.is_kept && is_slow(surface_.bvh, memory_.move))
      keep_found(surface_.bvh, memory_.upper + error, memory_, remaining(budget_, visitor.work.total()),
                 work_);
    return contact_found(surface_, visitor, reach_, error, memory_.upper, work_);
  }

  /// Leaves what was not shown open, unless it is beyond the reach.
  std::optional<Contact> unfinished(const BracketVisitor& visitor, const FilterPoint& point) noexcept {
    const WideBvh& bvh = surface_.bvh;
    remember(visitor, point, std::sqrt(bvh.frame().squared(visitor.left)));
    memory_.lower = std::max({0.0, memory_.lower, sampled_clearance(bvh, point)});
    is_open_ = !(memory_.lower > reach_);
    if (!is_open_) return std::nullopt;
    return contact_at(bvh.parts().triangles[memory_.slot], center_,
                      {visitor.offset, visitor.candidates.best().squared_distance},
                      bvh.ids()[visitor.candidates.best().index]);
  }

  const Surface& surface_;
  const Vec3& center_;
  double reach_;
  PointMemory& memory_;
  Work& work_;
  std::uint64_t budget_;
  bool is_open_ = false;
};

}  // namespace

Bracket nearest_bracket(const Surface& surface, const Probe& probe, double reach, std::uint64_t budget,
                        Session& session) noexcept {
  if (!asks_nearest(surface, probe, reach, session)) return {std::nullopt, reach, true};
  return BracketSearch(surface, probe.center, reach, session.memory, session.work, budget).run();
}

}  // namespace touchmark::queries
