/// The reference tree in single precision throughout: mesh, probe, boxes, kernel and distances. What a
/// program gets that has no doubles, to set its error beside its time.
///
/// Coordinates are kept as scale * (p - origin), the mesh's box about the origin and its extent near 1, so
/// that neither an offset nor a scale costs digits. Distances are within 54 u M + 2 u E, u = 2^-24, E the
/// box's largest extent: docs/exactness.md, E23.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/aabb.h"
#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark {

/// scale * (point - origin), `scale` a power of two.
struct FloatFrame {
  double scale = 1;
  Vec3 origin = Vec3::Zero();

  static FloatFrame around(const Aabb& bounds) noexcept;
  Eigen::Vector3f into(const Vec3& point) const noexcept { return (scale * (point - origin)).cast<float>(); }
};

/// A tree of boxes in single precision; satisfies AnswersTouches and AnswersNearest.
class FloatTree {
 public:
  /// What `build` may be told.
  struct Options {
    std::size_t leaf_size = 4;  ///< as in AabbTree
    unsigned threads = 1;       ///< as in AabbTree
  };
  /// What one haptic point remembers between ticks.
  struct Session {
    Work work;
    std::uint32_t last = 0;  ///< slot of the last nearest triangle: its distance bounds the next search
  };

  /// Throws as AabbTree::build does.
  static FloatTree build(const TriangleMesh& mesh, const Options& options);
  static FloatTree build(const TriangleMesh& mesh) { return build(mesh, Options()); }

  /// Centres farther than the squares of floats reach are taken to touch nothing.
  bool touches(const Probe& probe, Session& session) const noexcept;
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept;

  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept;

 private:
  using Point = Eigen::Vector3f;
  struct Triangle {
    std::array<Point, 3> corner;
    Point normal;  ///< unit; zero when the corners are collinear to rounding
    std::uint32_t index;
  };
  struct Node {
    Point min, max;
    std::uint32_t first, count;  ///< as in AabbTree
  };
  using Offset = OffsetIn<float>;

  static bool surely_over_face(const Triangle& t, const std::array<Point, 3>& to,
                               const std::array<float, 3>& squared) noexcept;
  static Offset offset_from(const Triangle& t, const Point& point) noexcept;
  float culling_pad(const Point& center) const noexcept;
  /// Calls consider(place) for the triangles of every leaf whose box is within limit(), nearest boxes first,
  /// until it returns true.
  template <class Limit, class Consider>
  void search(const Point& center, Work& work, const Limit& limit, const Consider& consider) const noexcept;
  Contact contact(const Triangle& t, const Vec3& center, const Offset& offset) const noexcept;

  FloatFrame frame_;
  double extent_ = 0;  ///< the largest, mesh units
  std::vector<Node> nodes_;
  std::vector<Triangle> triangles_;  ///< in the order of the leaves
  TriangleIds ids_;
};

}  // namespace touchmark
