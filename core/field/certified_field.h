/// A sampled distance field with a certificate: it answers from memory alone, by a plane or one triangle, and
/// is never wrong by more than was asked for. Elsewhere, or where that is asked for, an exact detector
/// answers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/detector.h"
#include "core/field/cell_octree.h"
#include "core/field/field_options.h"
#include "core/field/sample.h"
#include "core/geometry/point_triangle.h"
#include "core/geometry/widest_offset.h"
#include "core/triangle_mesh.h"

namespace touchmark {

/// The field over an exact detector; satisfies AnswersTouches and AnswersNearest, and AnswersSweep where that
/// does.
template <AnswersNearest Exact>
class CertifiedField {
 public:
  /// What `build` may be told.
  struct Options : FieldOptions {
    typename Exact::Options exact = {};
  };
  /// What one haptic point remembers between ticks.
  struct Session {
    Work work;
    field::CellOctree::Leaf leaf;
    Vec3 center = Vec3::Zero();
    double clear = 0;  ///< no triangle is nearer to that center
    typename Exact::Session exact;
  };

  /// Throws what the exact detector's build throws, and std::invalid_argument for an error or a band that is
  /// not a number of 0 or more, too many threads, or an error that takes too much memory.
  static CertifiedField build(const TriangleMesh& mesh, const Options& options) {
    const field::Division division = field::checked_division(options, mesh.diagonal());
    CertifiedField built(Exact::build(mesh, options.exact));
    built.refines_ = options.refines;
    built.band_ = division.band;
    built.ids_ = mesh.triangle_ids();
    built.triangles_ = prepare(mesh);
    built.octree_ = field::CellOctree(mesh, built.triangles_, division, [&] { return built.sampler(mesh); });
    return built;
  }
  static CertifiedField build(const TriangleMesh& mesh) { return build(mesh, Options()); }

  bool touches(const Probe& probe, Session& session) const noexcept {
    if (!(probe.radius >= 0)) return false;
    return answer<bool>(
        probe.center, probe.radius, session, [](const Vec3&, double) { return true; },
        [](const PreparedTriangle&, const Offset&) { return true; },
        [&](auto& exact) { return exact_->touches(probe, exact); });
  }
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept {
    if (!(reach >= 0)) return std::nullopt;
    return answer<std::optional<Contact>>(
        probe.center, reach, session,
        [&](const Vec3& place, double height) {
          Contact contact = octree_.contact(session.leaf, probe.center, place, height);
          contact.triangle = ids_[contact.triangle];
          return contact;
        },
        [&](const PreparedTriangle& triangle, const Offset& offset) {
          return contact_at(triangle, probe.center, offset, ids_[triangle.index]);
        },
        [&](auto& exact) { return exact_->nearest(probe, reach, exact); });
  }

  /// Sweeps are the exact detector's.
  std::optional<Impact> first_hit(const Sweep& sweep,
                                  Session& session) const noexcept requires AnswersSweep<Exact> {
    return ask(session, [&](auto& exact) { return exact_->first_hit(sweep, exact); });
  }

  /// Returns the detector that answers exactly, to be asked with a session of its own.
  const Exact& exact() const noexcept { return *exact_; }
  /// Returns how far an answer may be off, as it was proved when the field was built.
  double error() const noexcept { return octree_.error(); }

  std::size_t bytes() const noexcept {
    return exact_->bytes() + octree_.bytes() + triangles_.capacity() * sizeof(PreparedTriangle) +
           ids_.bytes();
  }
  Accuracy accuracy() const noexcept {
    if (refines_) return exact_->accuracy();
    return {Guarantee::approximate, kernel_relative_error, octree_.error()};
  }

 private:
  explicit CertifiedField(Exact exact) : exact_(std::make_unique<Exact>(std::move(exact))) {}

  /// Returns what one of the three says: of a place and its height above the leaf's plane, of a triangle and
  /// the offset from it, each within the reach, or what the exact detector is asked; else nothing.
  template <class Answer, class ByPlane, class ByTriangle, class Exactly>
  Answer answer(const Vec3& center, double reach, Session& session, const ByPlane& by_plane,
                const ByTriangle& by_triangle, const Exactly& exactly) const noexcept {
    const double margin = session.clear - reach;
    if (margin > 0 && (center - session.center).squaredNorm() < margin * margin) return {};
    if (octree_.empty()) return ask(session, exactly);
    const Vec3 place = octree_.place_of(center);
    const field::CellOctree::Leaf& leaf = session.leaf;
    if (!leaf.holds(place)) {
      ++session.work.cells;
      session.leaf = octree_.leaf_at(place);
    }
    if (leaf.is_none()) {
      if (!center.allFinite() || reach >= band_) return ask(session, exactly);
      return clear_by<Answer>(band_, center, session);
    }
    const auto decide = [&](double distance, const auto& found) -> Answer {
      if (distance - octree_.error() > reach)
        return clear_by<Answer>(distance - octree_.error(), center, session);
      if (refines_) return ask(session, exactly);
      return distance <= reach ? Answer(found()) : Answer();
    };
    if (leaf.is_plane()) {
      const double height = octree_.height(leaf, place);
      return decide(std::abs(height), [&] { return by_plane(place, height); });
    }
    const PreparedTriangle& triangle = triangles_[leaf.held];
    ++session.work.triangles;
    const Offset offset = widest_offset_from(triangle, center);
    return decide(std::sqrt(offset.squared), [&] { return by_triangle(triangle, offset); });
  }
  template <class Answer>
  static Answer clear_by(double distance, const Vec3& center, Session& session) noexcept {
    session.center = center;
    session.clear = distance * (1 - 0x1p-40);
    return {};
  }
  template <class Question>
  auto ask(Session& session, const Question& question) const noexcept {
    session.exact.work = {};
    const auto answer = question(session.exact);
    session.work += session.exact.work;
    return answer;
  }

  field::Sampler sampler(const TriangleMesh& mesh) const {
    return [this, &mesh, session = std::make_shared<typename Exact::Session>()](const Vec3& point,
                                                                                double reach) {
      const std::optional<Contact> contact = exact_->nearest({point, 0}, reach, *session);
      if (!contact) return field::Sample{std::numeric_limits<double>::infinity(), point, 0};
      return field::Sample{contact->distance, contact->point, triangle_of(mesh, *contact, point)};
    };
  }
  /// Returns which of the triangles of the contact's id it is on.
  std::uint32_t triangle_of(const TriangleMesh& mesh, const Contact& contact,
                            const Vec3& point) const noexcept {
    if (mesh.ids().empty()) return contact.triangle;
    const std::span<const TriangleId> ids = mesh.ids();
    const auto [first, last] = std::equal_range(ids.begin(), ids.end(), contact.triangle);
    const auto begin = static_cast<std::size_t>(first - mesh.ids().begin());
    return nearest_as_computed(std::span(triangles_).subspan(begin, static_cast<std::size_t>(last - first)),
                               point)
        .candidate.index;
  }

  std::unique_ptr<Exact> exact_;  ///< stays where it is when the field moves
  field::CellOctree octree_;
  std::vector<PreparedTriangle> triangles_;  ///< in the mesh's order
  TriangleIds ids_;
  double band_ = 0;
  bool refines_ = false;
};

}  // namespace touchmark
