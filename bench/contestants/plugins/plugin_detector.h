/// A plug-in's functions as a detector. What they cost beside the plug-in's own time is the call through a
/// pointer, and the probe and the answer once more in memory.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "bench/workload/answer.h"
#include "core/contestant.h"
#include "core/detector.h"
#include "core/mesh_update.h"

namespace touchmark::bench::contestants {

class PluginDetector {
 public:
  struct Options {
    const touchmark_plugin* plugin = nullptr;
    Guarantee claimed = Guarantee::exact;
    std::vector<touchmark_plugin_setting> settings;  ///< their texts live as long as the call of build
  };

  /// Holds the plug-in's own session, which is gone with it.
  class Session {
   public:
    Session() = default;
    Session(const touchmark_plugin& plugin, std::shared_ptr<void> detector);

    void* get() const noexcept { return session_.get(); }
    bool is_begun() const noexcept { return begun_; }
    Work work;  ///< stays at zero

   private:
    std::shared_ptr<void> session_;
    bool begun_ = false;  ///< false for one that no detector has made yet: the first query makes it
  };

  /// Throws std::invalid_argument with the text of the plug-in's build.
  static PluginDetector build(const TriangleMesh& mesh, const Options& options);

  Session session() const { return {*plugin_, detector_}; }
  bool answers(workload::Query query) const noexcept;
  bool updates() const noexcept { return plugin_->update != nullptr; }

  bool touches(const Probe& probe, Session& session) const noexcept {
    return plugin_->touches(detector_.get(), begun(session), &c_probe(probe)) != 0;
  }
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept {
    touchmark_plugin_contact contact{};
    if (plugin_->nearest(detector_.get(), begun(session), &c_probe(probe), reach, &contact) == 0)
      return std::nullopt;
    return contact_of(contact);
  }
  std::optional<Impact> first_hit(const Sweep& sweep, Session& session) const noexcept {
    const touchmark_plugin_sweep asked{{sweep.from.x(), sweep.from.y(), sweep.from.z()},
                                       {sweep.to.x(), sweep.to.y(), sweep.to.z()},
                                       sweep.radius};
    touchmark_plugin_impact impact{};
    if (plugin_->first_hit(detector_.get(), begun(session), &asked, &impact) == 0) return std::nullopt;
    return Impact{impact.fraction, contact_of(impact.contact)};
  }

  std::size_t bytes() const noexcept { return plugin_->bytes(detector_.get()); }
  Accuracy accuracy() const noexcept { return accuracy_; }
  /// Throws std::invalid_argument with the text of the plug-in's update, and for a mesh of other triangles.
  void update(const TriangleMesh& mesh);

 private:
  PluginDetector(const touchmark_plugin& plugin, const TriangleMesh& mesh, std::shared_ptr<void> detector,
                 Guarantee claimed);

  void* begun(Session& session) const noexcept {
    if (!session.is_begun()) session = this->session();
    return session.get();
  }
  /// Returns the probe where it lies, which has the layout of C: a copy made of single stores would keep a
  /// vector load waiting.
  static const touchmark_plugin_probe& c_probe(const Probe& probe) noexcept {
    static_assert(sizeof(Probe) == sizeof(touchmark_plugin_probe) &&
                  offsetof(Probe, radius) == offsetof(touchmark_plugin_probe, radius));
    return reinterpret_cast<const touchmark_plugin_probe&>(probe);
  }
  Contact contact_of(const touchmark_plugin_contact& contact) const noexcept {
    return {{contact.point[0], contact.point[1], contact.point[2]},
            {contact.normal[0], contact.normal[1], contact.normal[2]},
            contact.distance,
            id_of(contact.triangle),
            Side::unasked};
  }
  /// The index itself for one that is out of range, which the judge then finds to be no triangle's.
  TriangleId id_of(std::uint32_t triangle) const noexcept {
    return triangle < ids_.size() ? ids_[triangle] : triangle;
  }

  const touchmark_plugin* plugin_;
  std::shared_ptr<void> detector_;
  std::vector<TriangleId> ids_;  ///< by the mesh's order; empty where they are the same
  Accuracy accuracy_;
  Connectivity connectivity_;
};

}  // namespace touchmark::bench::contestants
