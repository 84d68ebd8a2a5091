/// A detector chosen at run time by the words of the command line, behind one face. What serves other
/// languages, core/c and the Python module, is made of it. A C++ program takes the detector's own class.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "core/detector.h"
#include "core/mesh_motion.h"
#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark {

/// Any of our detectors. Queries are those of the detector it holds: const, noexcept, without allocation, and
/// from many threads with a session each.
class NamedDetector {
 public:
  /// What one haptic point remembers between ticks, of the detector that began it.
  class Session {
   public:
    virtual ~Session() = default;
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

   protected:
    Session() = default;
  };

  /// `text` is "NAME" or "NAME:key=value,..." with a name of `names`: "grid-group:cell=1%,side=on".
  /// Throws std::invalid_argument naming the name, key or value that is wrong, and what the detector's build
  /// throws.
  static std::unique_ptr<NamedDetector> build(const TriangleMesh& mesh, std::string_view text);
  /// What can be built, separated by ", ".
  static std::string_view names() noexcept;

  virtual ~NamedDetector() = default;
  NamedDetector(const NamedDetector&) = delete;
  NamedDetector& operator=(const NamedDetector&) = delete;

  virtual std::unique_ptr<Session> begin_session() const = 0;

  /// A session must be one that this detector began.
  virtual bool touches(const Probe& probe, Session& session) const noexcept = 0;
  virtual std::optional<Contact> nearest(const Probe& probe, double reach,
                                         Session& session) const noexcept = 0;
  virtual std::optional<Impact> first_hit(const Sweep& sweep, Session& session) const noexcept = 0;
  virtual std::size_t contacts(const Probe& probe, double reach, Session& session,
                               std::span<Contact> into) const noexcept = 0;
  /// Returns the session's work, which may be limited; null where the detector keeps to no limit.
  virtual LimitedWork* limited_work(Session& session) const noexcept = 0;
  /// Throws std::invalid_argument where a proxy's work is to be limited and the detector keeps to no limit.
  void expect_limited(std::uint64_t max_work, Session& session) const;
  /// See the concept AnswersMovingSweep. Returns nothing where sees_mesh_motion() is false.
  virtual std::optional<Impact> first_hit_moving(const Sweep& sweep, const MeshMotion& motion,
                                                 Session& session) const noexcept = 0;
  virtual bool sees_mesh_motion() const noexcept = 0;
  /// Throws std::invalid_argument where a proxy is to be pushed by a mesh whose motion is not seen.
  void expect_sees_mesh_motion() const;
  /// Does nothing where the detector prepares nothing.
  virtual void prepare(Session& session) const noexcept = 0;
  virtual std::size_t bytes() const noexcept = 0;
  virtual Accuracy accuracy() const noexcept = 0;

  /// See the concept Updates.
  virtual void update(const TriangleMesh& mesh) = 0;

 protected:
  NamedDetector() = default;
};

}  // namespace touchmark
