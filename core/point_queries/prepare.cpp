#include <array>

#include "core/point_queries/near_leaves.h"
#include "core/point_queries/queries.h"

namespace touchmark::queries {
namespace {

/// The queries as ask_again has them.
struct Asked {
  const Surface& surface;

  void touches(const Probe& probe, PointMemory& memory, LimitedWork& work) const noexcept {
    queries::touches(surface, probe, memory, work);
  }
  void nearest(const Vec3& center, double reach, PointMemory& memory, LimitedWork& work) const noexcept {
    queries::nearest(surface, center, reach, memory, work);
  }
  void first_hit(const Sweep& sweep, PointMemory& memory, LimitedWork& work) const noexcept {
    queries::first_hit(surface, sweep, memory, work);
  }
  void contacts(const Vec3& center, double reach, PointMemory& memory, LimitedWork& work) const noexcept {
    std::array<Contact, 16> into;
    queries::contacts(surface, center, reach, memory, into, false, work);
  }
};

}  // namespace

void prepare(const Surface& surface, const LastQuestion& question, PointMemory& memory,
             LimitedWork& work) noexcept {
  const WideBvh& bvh = surface.bvh;
  if (memory.epoch != bvh.epoch() || is_clear(bvh, memory.center, question.reach, memory)) return;
  const Vec3 move = stays_among_listed_leaves(bvh, memory.move) ? memory.move : Vec3(Vec3::Zero());
  const bool looks_at_leaves =
      question.query == LastQuestion::Query::nearest || question.query == LastQuestion::Query::sweep;
  if (looks_at_leaves && memory.is_near()) refill_ahead(bvh, memory, work);
  const Vec3 kept = memory.move, free_center = memory.free_center;
  const double free_radius = memory.free_radius;
  ask_again(Asked{surface}, question, memory.center + move, move, memory, work);
  memory.move = kept;
  memory.free_center = free_center;
  memory.free_radius = free_radius;
}

}  // namespace touchmark::queries
