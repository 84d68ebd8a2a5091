/// Scenes of bodies over the detectors of one mesh: each body is asked in its own frame. For rivals, whose
/// libraries find the body, and for plain loops.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "baselines/reach.h"
#include "core/aabb.h"
#include "core/detector.h"
#include "core/scene/body.h"
#include "core/scene/pose.h"
#include "core/triangle_mesh.h"

namespace touchmark::baselines {

/// What a scene is built of. Bodies are named by their places in the list.
struct PosedScene {
  struct Body {
    std::uint32_t shape = 0;
    Pose pose;
  };
  std::vector<std::shared_ptr<const TriangleMesh>> shapes;
  std::vector<Body> bodies;
};

/// What poses in double add to a detector's error: a centre taken into a body's frame and a contact taken
/// back are rounded by a few roundings of their lengths, and a rotation is off orthonormal by a few.
inline Accuracy with_poses(Accuracy accuracy, double largest_coordinate) noexcept {
  constexpr double roundings = 32 * (std::numeric_limits<double>::epsilon() / 2);
  accuracy.relative += 2 * roundings;
  accuracy.absolute += roundings * largest_coordinate;
  accuracy.decides_exactly = accuracy.names_exactly = false;
  return accuracy;
}

/// Returns a box that holds the image of a box under a pose, rounding included.
inline Aabb image_of_box(const Pose& pose, const Aabb& box) noexcept {
  const Vec3 half = pose.rotation.cwiseAbs() * (0.5 * box.extent());
  const Vec3 center = image(pose, box.center());
  const Vec3 pad = 16 * std::numeric_limits<double>::epsilon() *
                   (half + pose.rotation.cwiseAbs() * box.center().cwiseAbs() + pose.translation.cwiseAbs());
  return {center - half - pad, center + half + pad};
}

inline Contact placed_contact(const Pose& pose, Contact contact) noexcept {
  contact.point = image(pose, contact.point);
  contact.normal = (pose.rotation * contact.normal).eval();
  return contact;
}

/// The bodies' detectors and where they are. Which bodies are asked, and in which order, is the caller's.
template <Detector D>
class PosedShapes {
 public:
  struct Session {
    Work work;
    std::vector<typename D::Session> of_bodies;
  };

  PosedShapes(const PosedScene& scene, const typename D::Options& options) : bodies_(scene.bodies) {
    for (const auto& mesh : scene.shapes) {
      shapes_.push_back(D::build(*mesh, options));
      bounds_.push_back(mesh->bounds());
      largest_ = std::max(largest_, largest_coordinate(mesh->bounds()));
    }
  }

  std::size_t size() const noexcept { return bodies_.size(); }
  const Pose& pose(std::uint32_t body) const noexcept { return bodies_[body].pose; }
  void place(std::uint32_t body, const Pose& pose) { bodies_[body].pose = pose; }
  Aabb box(std::uint32_t body) const noexcept {
    return image_of_box(bodies_[body].pose, bounds_[bodies_[body].shape]);
  }

  /// Replaces the best contact by the body's where that is nearer; of as near ones the lowest body's stays.
  void consider(std::uint32_t body, const Probe& probe, double reach, Session& session,
                std::optional<BodyContact>& best) const {
    const Pose& pose = bodies_[body].pose;
    const double limit = best ? std::min(reach, best->contact.distance) : reach;
    ask(body, session, [&](const D& shape, typename D::Session& own) {
      const auto found = shape.nearest({in_frame(pose, probe.center), probe.radius}, limit, own);
      if (found && (!best || found->distance < best->contact.distance ||
                    (found->distance == best->contact.distance && body < best->body.index)))
        best = BodyContact{{body, 0}, placed_contact(pose, *found)};
    });
  }
  /// Replaces the first touch by the body's where that is earlier; of those at the same moment the nearest
  /// counts.
  void consider(std::uint32_t body, const Sweep& sweep, Session& session,
                std::optional<BodyImpact>& first) const requires AnswersSweep<D> {
    const Pose& pose = bodies_[body].pose;
    ask(body, session, [&](const D& shape, typename D::Session& own) {
      const Sweep seen{in_frame(pose, sweep.from), in_frame(pose, sweep.to), sweep.radius};
      const auto found = shape.first_hit(seen, own);
      if (!found || (first && !is_before(body, *found, *first))) return;
      first = BodyImpact{{body, 0}, {found->fraction, placed_contact(pose, found->contact)}};
    });
  }

  std::size_t bytes() const noexcept {
    std::size_t sum = bodies_.capacity() * sizeof(bodies_[0]);
    for (const D& shape : shapes_) sum += shape.bytes();
    return sum;
  }
  Accuracy accuracy() const noexcept { return with_poses(shapes_.front().accuracy(), largest_); }

 private:
  template <class Ask>
  void ask(std::uint32_t body, Session& session, const Ask& ask) const {
    if (session.of_bodies.size() < bodies_.size()) session.of_bodies.resize(bodies_.size());
    typename D::Session& own = session.of_bodies[body];
    ask(shapes_[bodies_[body].shape], own);
    ++session.work.bodies;
    session.work += own.work;
    own.work = {};
  }
  static bool is_before(std::uint32_t body, const Impact& impact, const BodyImpact& first) noexcept {
    if (impact.fraction != first.impact.fraction) return impact.fraction < first.impact.fraction;
    if (impact.contact.distance != first.impact.contact.distance)
      return impact.contact.distance < first.impact.contact.distance;
    return body < first.body.index;
  }

  std::vector<D> shapes_;
  std::vector<Aabb> bounds_;  ///< by shape
  std::vector<PosedScene::Body> bodies_;
  double largest_ = 0;
};

}  // namespace touchmark::baselines
