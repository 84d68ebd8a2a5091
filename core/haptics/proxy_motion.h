/// What a proxy does between two questions to a detector: where it tries to go, what it makes of what it met,
/// and what a tick came to. It decides nothing about the surface; core/haptics/proxy.h asks for that.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/haptics/contact_planes.h"
#include "core/haptics/coupling.h"
#include "core/haptics/force_planes.h"
#include "core/haptics/force_shading.h"
#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark {

/// How a proxy is.
enum class ProxyStatus : std::uint8_t {
  free,        ///< nothing holds it: it is at its goal
  in_contact,  ///< the surface holds it
  stuck,      ///< it was put too near to the surface, or the surface was moved onto it, and it is not off yet
  unanswered  ///< the goal is no number; the proxy stays
};

/// What one tick came to.
struct ProxyState {
  static constexpr std::size_t max_pieces = 24;

  Vec3 position = Vec3::Zero();
  ProxyStatus status = ProxyStatus::free;
  std::size_t contacts = 0;  ///< how many planes hold it, 3 at most; at least 1 unless it is free
  std::array<Vec3, ContactPlanes::max_active> normals;  ///< theirs, unit, out of the surface
  std::array<Vec3, ContactPlanes::max_active> points;   ///< the places on the surface that they touch
  /// The triangles there; nothing where none is known.
  std::array<std::optional<TriangleId>, ContactPlanes::max_active> triangles;
  Vec3 force = Vec3::Zero();  ///< N, on the device
  /// The straight pieces of the tick's way: from way[0], where it was, over each to `position`.
  std::array<Vec3, max_pieces + 1> way;
  std::size_t pieces = 0;
  /// A piece on which the proxy rested in the frame of a body that moved.
  struct Carry {
    std::size_t body = 0;       ///< by its place in what `bodies_moved` was given
    double begin = 0, end = 1;  ///< when, as parts of the tick of the bodies
  };
  static constexpr std::size_t max_carries = 4;
  /// The first pieces of the way: the ends are as told, but the way between them is the body's.
  std::array<Carry, max_carries> carries;
  std::size_t carried = 0;  ///< how many they are
  /// The step ended at Coupling::max_work, where it was by then. The next one goes on.
  bool unfinished = false;
};

class ProxyMotion {
 public:
  ProxyMotion(const Coupling& coupling, const TriangleMesh* mesh, const ForceShading* shading) noexcept;

  void place(const Vec3& position) noexcept;
  /// Forgets what it knew of the surface, which is now elsewhere.
  void surface_moved(const TriangleMesh* mesh) noexcept;
  /// Says how large the coordinates of a surface are that is no mesh.
  void set_surface_size(double largest) noexcept { mesh_size_ = largest; }

  const ProxyState& state() const noexcept { return state_; }
  const Vec3& position() const noexcept { return state_.position; }
  const Coupling& coupling() const noexcept { return coupling_; }
  void limit_work(std::uint64_t max_work) noexcept { coupling_.max_work = max_work; }
  ForcePlanes planes() const noexcept { return {state_, goal_, coupling_}; }
  /// The distance that this tick keeps: more than that it stays off the surface.
  double kept() const noexcept { return kept_; }
  void keep(double distance) noexcept { kept_ = distance; }
  /// It was put there, or the surface has moved: is it off?
  bool may_touch() const noexcept { return may_touch_; }
  /// The largest share of the radius known to be free where it stands, in eighths; nothing where it was just
  /// put there, or the surface has just moved.
  const std::optional<int>& free_eighths() const noexcept { return free_eighths_; }
  /// It is free by so many eighths of the radius: this tick keeps that. With all of them it is off.
  void is_free_by(int eighths) noexcept {
    free_eighths_ = eighths;
    kept_ = coupling_.radius * eighths / 8;
    may_touch_ = eighths < 8;
  }

  /// Begins the way of a tick. What has moved may carry the proxy before it goes by itself.
  void begin_way(const Vec3& at) noexcept;
  void carry(const Vec3& to, const ProxyState::Carry& carry) noexcept;
  /// Begins a tick. Returns false where there is nothing to be found out: the goal and all else are as they
  /// were when it came to rest, or the goal is no number.
  bool begin(const Vec3& goal) noexcept;
  /// Returns where to go next, or nothing where it is as near to the goal as it knows how to come.
  std::optional<Vec3> next_target() noexcept;
  /// Goes to a point that is surely free to go to.
  void go(const Vec3& to) noexcept;
  bool is_at_goal() const noexcept { return state_.position == goal_; }
  /// Returns by how much larger a ball to sweep to a target with: by so much that up to where it is met the
  /// way is surely free for the proxy, however `approach` rounds. 0 where the goal itself is the target,
  /// which is to be reached where it is free, and where coordinates are too far for that.
  double margin(const Vec3& target) const noexcept;
  /// Returns where to go towards a target that something is in the way of: the fraction rounded down, and
  /// back from there by what lets doubles decide. Each `retreat` is farther back; nothing where that is
  /// nowhere.
  std::optional<Vec3> approach(const Vec3& target, const Impact& impact, int retreat) const noexcept;
  /// Takes the plane of what was met on the way to a target.
  void meet(const Impact& impact, const Vec3& target) noexcept;
  /// How far around the position contacts are of interest, as a distance to the surface.
  double look() const noexcept;
  /// Takes the planes of the contacts around the position, nearest first, for those before.
  void look_around(std::span<const Contact> contacts) noexcept;
  /// Ends a tick. One that came no nearer to its goal is taken back. One that could not ask all it wanted to
  /// know is unfinished.
  const ProxyState& end(bool is_unfinished) noexcept;

  static constexpr int max_retreats = 3;
  static constexpr std::size_t max_contacts = 16;  ///< the nearest of those around

 private:
  bool is_surely_blocked() const noexcept;
  std::optional<Vec3> descent() noexcept;
  std::optional<Vec3> face_normal(TriangleId id) const noexcept;
  double normal_error(double distance) const noexcept;
  std::optional<Vec3> normal_at(const Contact& contact) const noexcept;
  Vec3 met_normal(const Impact& impact, const Vec3& target) const noexcept;
  bool came_nearer() const noexcept;
  void note_contacts() noexcept;
  void set_force() noexcept;

  Coupling coupling_;
  const ForceShading* shading_ = nullptr;
  const TriangleMesh* mesh_ = nullptr;
  double mesh_size_ = 0;  ///< the mesh's largest coordinate
  ProxyState state_;
  Vec3 goal_ = Vec3::Zero(), goal_before_ = Vec3::Zero();
  ContactPlanes planes_;
  double kept_ = 0;
  double size_ = 0;        ///< the largest coordinates that take part in this tick's questions
  double skin_ = 0;        ///< so far off it stays besides, so that doubles decide most questions
  double last_slide_ = 0;  ///< length of the tick's last piece, if that was along planes
  int rounds_ = 0;
  int slides_ = 0;                   ///< along planes, since something was met
  int descents_ = 0;                 ///< straight on towards the goal, after the last slide
  int same_goal_ = 0;                ///< ticks since the goal last changed
  bool may_touch_ = true;            ///< it was put there, or the surface has moved
  std::optional<int> free_eighths_;  ///< see free_eighths()
  bool has_moved_ = false;           ///< since the last target was chosen
  bool has_slid_ = false;            ///< friction allows one slide a tick
  bool rests_ = false;               ///< the last tick did not move it
};

}  // namespace touchmark
