/// What one haptic point knows of the bodies of a scene: the nearest few by name, and how far all others are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "core/probe.h"
#include "core/scene/body.h"
#include "core/scene/clearance.h"
#include "core/scene/scene_bodies.h"
#include "core/scene/seen_body.h"
#include "core/search/memory/epoch.h"

namespace touchmark {

/// Returns what the distance of the point to the body's image cannot fall below, by the bounds of its shape.
double lower_distance(const SceneBodies& bodies, std::uint32_t body, const Vec3& point) noexcept;
/// Returns the same for a body of a shape with these bounds that is seen from the point.
double lower_distance(const Aabb& bounds, const SeenBody& seen) noexcept;

/// Forgetting it changes the cost of the next answer, never the answer.
class NearBodies {
 public:
  static constexpr std::size_t room = 16;
  /// Bodies that are not listed share so many memories, by their shapes.
  static constexpr std::size_t unlisted_room = 8;
  struct Entry {
    BodyId id;
    std::uint32_t slot = 0;  ///< the place of what is remembered of the body, below `room`
    double lower = 0;        ///< bound of the distance when that was last asked for
    Clearance seen;          ///< what was found of this body alone

    /// The body is at least so far from there.
    void raise(const Vec3& point, double bound, const SceneBodies& bodies) noexcept {
      if (!(bound > lower)) return;
      lower = bound;
      seen = Clearance::at(point, bound, bodies);
    }
  };

  /// Is every body surely farther than the reach? One comparison, whatever the number of bodies.
  bool all_are_beyond(const Vec3& point, double reach, const SceneBodies& bodies) const noexcept {
    return all_.clears(point, reach, bodies);
  }
  /// Returns the place from which that was found.
  const Vec3& center_of_all() const noexcept { return all_.center; }
  /// Are those that are not listed?
  bool others_are_beyond(const Vec3& point, double reach, const SceneBodies& bodies) const noexcept {
    return others_.clears(point, reach, bodies);
  }
  std::span<Entry> listed() noexcept { return {entries_.data(), count_}; }
  std::span<const Entry> listed() const noexcept { return {entries_.data(), count_}; }
  /// Those of them that were looked at last; the others are beyond the reach.
  std::span<const Entry> near() const noexcept { return {entries_.data(), near_count_}; }
  std::span<Entry> near() noexcept { return {entries_.data(), near_count_}; }
  /// Returns the slot of a body, or `room` for one that is not listed.
  std::size_t slot_of(const BodyId& id) const noexcept;

  /// All bodies are at least so far from there, as was found otherwise.
  void know_clear(const Vec3& point, double lower, const SceneBodies& bodies) noexcept {
    all_ = Clearance::at(point, lower, bodies);
  }
  /// Would a list of the nearest bodies serve some more ticks as long as this one? It is asked once a query.
  bool pays_to_list(const Vec3& point) noexcept;
  /// Notes where the point is that the last query answered without pays_to_list.
  void was_at(const Vec3& point) noexcept { last_ = point; }
  /// Said the last call of pays_to_list no?
  bool is_jumping() const noexcept { return is_jumping_; }
  /// Learns by how much the bodies that are not listed are beyond what was asked.
  void learn_gap(double reach) noexcept;

  /// Lists the bodies nearest to the point by their bounds. Returns how many boxes and bodies it looked at.
  struct Looked {
    std::uint64_t boxes = 0, bodies = 0;
  };
  Looked list(const Vec3& point, double reach, const SceneBodies& bodies) noexcept;
  /// Drops the listed bodies that are removed, and bounds the distances of the others from there; but not of
  /// those that are listed last and surely beyond the reach. Returns how many it looked at.
  std::size_t look_again(const Vec3& point, double reach, const SceneBodies& bodies) noexcept;
  /// Says how far all bodies are, now that all that was listed was looked at again from there.
  void conclude(const Vec3& point, const SceneBodies& bodies) noexcept;

 private:
  void add(const Entry& entry) noexcept;
  void know_all_are_there(const SceneBodies& bodies) noexcept {
    epoch_ = bodies.epoch();
    removals_ = bodies.removals();
  }
  /// Lists first those that may soon be within the reach, and says how far the others are.
  void part(const Vec3& point, double reach, const SceneBodies& bodies) noexcept;

  std::array<Entry, room> entries_;  ///< the nearest first when they were listed
  std::size_t count_ = 0;
  std::size_t near_count_ = 0;
  Clearance all_;
  Clearance listed_last_;  ///< about those listed after the near ones
  Clearance others_;
  Epoch epoch_;                 ///< the scene's that had all that are listed
  std::uint64_t removals_ = 0;  ///< when it had lost so many bodies
  Vec3 last_ = Vec3::Zero();    ///< the point that pays_to_list was asked about last
  double step_ = 0;
  bool was_asked_ = false, is_jumping_ = false;
  double gap_ = std::numeric_limits<double>::infinity();  ///< what a list is good for, as was seen
};

}  // namespace touchmark
