/// Our proxy over a contestant. Its questions go through one virtual call each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "bench/contestants/contestant.h"
#include "core/haptics/force_shading.h"
#include "core/haptics/proxy.h"
#include "core/mesh_motion.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::contestants {

/// Any contestant as a detector that a proxy can ask. Its session is its own.
class AskedContestant {
 public:
  struct Session {};

  explicit AskedContestant(std::unique_ptr<Contestant> contestant) : contestant_(std::move(contestant)) {}

  bool touches(const Probe& probe, Session&) const noexcept { return contestant_->touches(probe); }
  std::optional<Impact> first_hit(const Sweep& sweep, Session&) const noexcept {
    return contestant_->first_hit(sweep, nullptr);
  }
  std::optional<Impact> first_hit_moving(const Sweep& sweep, const MeshMotion& motion,
                                         Session&) const noexcept {
    return contestant_->first_hit(sweep, &motion);
  }
  std::size_t contacts(const Probe& probe, double reach, Session&, std::span<Contact> into) const noexcept {
    return contestant_->contacts(probe, reach, into);
  }
  void update(const TriangleMesh& mesh) { contestant_->update(mesh); }
  bool stand_at(const workload::QueryTrace& trace, std::size_t step) noexcept {
    return contestant_->stand_at(trace, step);
  }
  bool prepares() const noexcept { return contestant_->prepares() || contestant_->prepares_after_moves(); }
  void prepare_next() noexcept { contestant_->prepare_next(); }
  Work work() const { return contestant_->work(); }
  LimitedWork* limited_work(Session&) const noexcept { return contestant_->limited_work(); }

 private:
  std::unique_ptr<Contestant> contestant_;
};

/// A proxy with all that it refers to.
class GuidedProxy {
 public:
  /// The contestant must guide proxies. `mesh` is what it was built of; none: a scene, where no force is
  /// shaded.
  GuidedProxy(std::unique_ptr<Contestant> contestant, std::optional<TriangleMesh> mesh,
              const Coupling& coupling)
      : mesh_(std::move(mesh)),
        shading_(mesh_ ? std::optional<ForceShading>(*mesh_) : std::nullopt),
        detector_(std::move(contestant)),
        proxy_(detector_, coupling, mesh_ ? &*mesh_ : nullptr, shading_ ? &*shading_ : nullptr) {}
  GuidedProxy(const GuidedProxy&) = delete;
  GuidedProxy& operator=(const GuidedProxy&) = delete;

  void place(const Vec3& position) noexcept { proxy_.place(position); }
  const ProxyState& step(const Vec3& goal) noexcept { return proxy_.step(goal, session_); }
  /// Returns false where the contestant keeps to no limit.
  bool limit_work(std::uint64_t max_work) noexcept {
    proxy_.limit_work(max_work);
    return detector_.limited_work(session_) != nullptr;
  }
  /// Returns false if the mesh may have passed the proxy on its way: the contestant does not see the motion,
  /// or finds no way out of it.
  bool update(const TriangleMesh& mesh) {
    const bool is_pushed = proxy_.surface_moving(MeshMotion(*mesh_, mesh), session_);
    detector_.update(mesh);
    mesh_ = mesh;
    shading_.emplace(*mesh_);
    proxy_.surface_moved(&*mesh_);
    return is_pushed;
  }
  /// Does what a loop does before it reads its device: moves the bodies of a scene to where they are at this
  /// step, and prepares.
  void get_ready(const workload::QueryTrace& trace, std::size_t step) noexcept {
    if (detector_.stand_at(trace, step)) proxy_.surface_moved();
    detector_.prepare_next();
  }
  /// True if getting ready is work, too.
  bool prepares() const noexcept { return detector_.prepares(); }
  Work work() const { return detector_.work(); }

 private:
  std::optional<TriangleMesh> mesh_;
  std::optional<ForceShading> shading_;
  AskedContestant detector_;
  AskedContestant::Session session_;
  Proxy<AskedContestant> proxy_;
};

/// What a tick came to as one number: its way, its contacts and its force, to the bit.
inline std::uint64_t checksum_of(const ProxyState& state) noexcept {
  workload::Checksum sum;
  const auto add = [&sum](const Vec3& v) {
    for (const double x : {v.x(), v.y(), v.z()}) sum.add({1, 0, 0, x});
  };
  for (std::size_t i = 0; i <= state.pieces; ++i) add(state.way[i]);
  add(state.force);
  sum.add({static_cast<std::uint32_t>(state.status), static_cast<TriangleId>(state.contacts)});
  return sum.value();
}

}  // namespace touchmark::bench::contestants
