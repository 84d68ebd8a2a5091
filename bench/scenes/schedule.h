/// The places of bodies at each step of a trajectory, worked out ahead, so that nothing of it is in a tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "bench/scenes/body_scene.h"

namespace touchmark::bench::scenes {

/// One body's pose from a step on. Plain numbers, since they cross process borders as bytes.
struct BodyMove {
  std::uint64_t body = 0;
  double rotation[9] = {};  ///< a row after the other
  double translation[3] = {};

  static BodyMove of(std::uint32_t body, const Pose& pose) noexcept {
    BodyMove move;
    move.body = body;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) move.rotation[3 * row + column] = pose.rotation(row, column);
      move.translation[row] = pose.translation[row];
    }
    return move;
  }
  Pose pose() const noexcept {
    Pose pose;
    pose.rotation << rotation[0], rotation[1], rotation[2], rotation[3], rotation[4], rotation[5],
        rotation[6], rotation[7], rotation[8];
    pose.translation << translation[0], translation[1], translation[2];
    return pose;
  }
};
static_assert(std::is_trivially_copyable_v<BodyMove> && sizeof(BodyMove) == 104);

/// The moves before each step. Every so many steps all moving bodies are there, whether they moved or not.
struct ScheduleView {
  static constexpr std::size_t whole_frame_every = 32;

  std::span<const std::uint64_t> first;  ///< step i's moves are [first[i], first[i + 1]); empty: all stands
  std::span<const BodyMove> moves;

  std::size_t steps() const noexcept { return first.empty() ? 0 : first.size() - 1; }
  std::span<const BodyMove> at(std::size_t step) const noexcept {
    return moves.subspan(first[step], first[step + 1] - first[step]);
  }
};

struct Schedule {
  std::vector<std::uint64_t> first;
  std::vector<BodyMove> moves;

  ScheduleView view() const noexcept { return {first, moves}; }
};

/// The poses at these times, one a step. Throws PoseError or ResourceError.
Schedule schedule_of(const BodyMotion& motion, std::span<const double> times_s);

/// The first steps of a schedule.
Schedule beginning(const Schedule& schedule, std::size_t steps);

/// Follows a schedule from step to step: calls place(body, pose) for the bodies that are elsewhere than after
/// the call before. `stood(body)` is where a body is at the start, to which those of a schedule before go
/// back. The schedules must outlive it.
class ScheduleFollower {
 public:
  template <class Place, class Stood>
  void stand_at(const ScheduleView* schedule, std::size_t step, const Place& place, const Stood& stood) {
    if (schedule != schedule_) {
      if (schedule_ != nullptr) {
        for (const BodyMove& move : moves_of_first_step(*schedule_))
          place(static_cast<std::uint32_t>(move.body), stood(static_cast<std::uint32_t>(move.body)));
      }
      schedule_ = schedule;
      step_ = nowhere;
    }
    if (schedule == nullptr || step >= schedule->steps() || step == step_) return;
    // One step on is its moves alone; elsewhere it takes those since all bodies were there.
    std::size_t begin = step;
    if (step_ == nowhere || step != step_ + 1) {
      const std::size_t all = moves_of_first_step(*schedule).size();
      while (schedule->at(begin).size() < all) --begin;
    }
    for (; begin <= step; ++begin)
      for (const BodyMove& move : schedule->at(begin))
        place(static_cast<std::uint32_t>(move.body), move.pose());
    step_ = step;
  }

 private:
  static constexpr std::size_t nowhere = ~std::size_t{0};
  static std::span<const BodyMove> moves_of_first_step(const ScheduleView& schedule) {
    return schedule.steps() == 0 ? std::span<const BodyMove>() : schedule.at(0);
  }

  const ScheduleView* schedule_ = nullptr;
  std::size_t step_ = nowhere;
};

/// A scene without its names, as contestants are built of it.
struct PlacedScene {
  struct PlacedBody {
    std::uint32_t shape = 0;
    Pose start;
  };
  std::vector<std::shared_ptr<const TriangleMesh>> shapes;
  std::vector<PlacedBody> bodies;
  bool moves = false;              ///< some body is asked to move
  std::vector<double> radii = {};  ///< one a shape, above 0 where its mesh is a round one's axis; or none
  std::vector<bool> near = {};     ///< one a shape: is a body of it ever near a probe? None: it is not known.

  bool is_near(std::size_t shape) const noexcept { return near.empty() || near[shape]; }
  double radius_of(std::size_t shape) const noexcept { return radii.empty() ? 0 : radii[shape]; }
};

/// Throws PoseError.
PlacedScene placed(const BodyScene& scene);

}  // namespace touchmark::bench::scenes
