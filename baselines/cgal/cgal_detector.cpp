#include "baselines/cgal/cgal_detector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <Eigen/Geometry>

namespace touchmark::baselines {

/// What the kernels have in common.
struct CgalDetector::Model : RivalModel<CgalDetector::Options> {
  Model(const TriangleMesh& mesh, const Options& chosen) : RivalModel(mesh, chosen) {
    ids = mesh.triangle_ids();
  }
  virtual ~Model() = default;

  /// The closest point of the mesh, when it is within reach.
  struct Found {
    Vec3 point;
    Vec3 away;  ///< from there to the centre
    double distance;
    std::uint32_t index;     ///< its triangle's position in the tree
    std::uint32_t triangle;  ///< the mesh's id
  };
  /// `reach` is finite, `last` the place of a triangle to start from.
  virtual std::optional<Found> nearest(const Vec3& center, double reach, std::uint32_t last) const = 0;
  /// Asks the triangle at `last` first, and leaves there where the one is kept that is touched.
  virtual bool touches(const Probe& probe, std::uint32_t& last) const = 0;
  virtual Vec3 face_normal(std::uint32_t index) const = 0;
  virtual std::size_t tree_bytes() const = 0;
};

namespace {

using Model = CgalDetector::Model;

/// A point just beyond the reach. CGAL finds the closest of the mesh and the start, so it finds this one when
/// nothing is within reach, and never looks farther.
Vec3 beyond(const Aabb& bounds, const Vec3& center, double reach) {
  const double largest = std::max(center.cwiseAbs().maxCoeff(), largest_coordinate(bounds));
  // More than the roundings of the coordinates, of a closest point among them, and of squared distances.
  constexpr double roundings = 32 * std::numeric_limits<double>::epsilon();
  return center + Vec3(reach + roundings * (reach + largest), 0, 0);
}

template <class Kernel>
class TreeModel final : public Model {
 public:
  static constexpr bool is_exact = std::is_same_v<Kernel, CGAL::Epeck>;

  TreeModel(const TriangleMesh& mesh, const CgalDetector::Options& chosen) : Model(mesh, chosen) {
    triangles_.reserve(mesh.size());
    for (std::uint32_t i = 0; i < mesh.size(); ++i) add(mesh, i);
    if (triangles_.empty()) throw MeshError("cgal: no triangle of the mesh has an area");
    tree_.insert(triangles_.begin(), triangles_.end());
    // Both are built at the first query otherwise, which is too late for threads that share the tree.
    tree_.build();
    if (options.hint == CgalDetector::Hint::none) {
      tree_.accelerate_distance_queries();
    } else {
      tree_.do_not_accelerate_distance_queries();
    }
  }

  std::optional<Found> nearest(const Vec3& at, double reach, std::uint32_t last) const override {
    const Point center = into(at);
    const auto [point, triangle] = closest(center, at, reach, last);
    if (triangle == triangles_.end()) return std::nullopt;
    const typename Kernel::Vector_3 away = center - point;
    const FT squared = away.squared_length();
    Found found{from(point), from(CGAL::ORIGIN + away), rounded_root(squared), index_of(triangle), 0};
    found.triangle = indices_[found.index];
    const bool within = is_exact ? squared <= FT(reach) * FT(reach) : found.distance <= reach;
    return within ? std::optional(found) : std::nullopt;
  }

  bool touches(const Probe& probe, std::uint32_t& last) const override {
    const Point center = into(probe.center);
    const FT squared = FT(probe.radius) * FT(probe.radius);
    if (last < triangles_.size() && CGAL::squared_distance(center, triangles_[last]) <= squared) return true;
    BallTouch touch{squared, {center, squared}};
    tree_.traversal(center, touch);
    last = touch.found ? index_of(*touch.found) : no_triangle;
    return touch.found.has_value();
  }

  Vec3 face_normal(std::uint32_t index) const override {
    const Triangle& t = triangles_[index];
    const Vec3 a = from(t[0]);
    return (from(t[1]) - a).cross(from(t[2]) - a).normalized();
  }

  std::size_t tree_bytes() const override {
    const std::size_t n = triangles_.size();
    const std::size_t boxes = n * (sizeof(Primitive) + sizeof(CGAL::AABB_node<Traits>));
    // The k-d tree has a point with its primitive, a pointer to it, and a node for every few.
    const std::size_t points =
        options.hint == CgalDetector::Hint::none ? n * (sizeof(Point) + 4 * sizeof(void*)) : 0;
    // An exact number is a handle: behind it an interval, and the number where it was asked for.
    constexpr std::size_t behind = is_exact ? 9 * 48 : 0;
    return n * (sizeof(Triangle) + behind + sizeof(std::uint32_t)) + boxes + points;
  }

 private:
  using FT = typename Kernel::FT;
  using Point = typename Kernel::Point_3;
  using Triangle = typename Kernel::Triangle_3;
  using Iterator = typename std::vector<Triangle>::const_iterator;
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Iterator>;
  using Traits = CGAL::AABB_traits<Kernel, Primitive>;
  using Tree = CGAL::AABB_tree<Traits>;
  using Closest = typename Tree::Point_and_primitive_id;

  /// CGAL's own predicates along its own hierarchy, for a ball: its do_intersect takes a sphere for hollow,
  /// and misses what lies inside.
  struct BallTouch {
    FT squared_radius;
    typename Kernel::Sphere_3 ball;
    std::optional<Iterator> found{};

    bool go_further() const { return !found; }
    void intersection(const Point& center, const Primitive& primitive) {
      if (!found && CGAL::squared_distance(center, primitive.datum()) <= squared_radius)
        found = primitive.id();
    }
    bool do_intersect(const Point&, const CGAL::AABB_node<Traits>& node) const {
      return CGAL::do_intersect(ball, node.bbox());
    }
  };

  /// CGAL projects on a triangle's plane, and divides by the square of its area.
  void add(const TriangleMesh& mesh, std::uint32_t index) {
    const Triangle triangle(into(mesh.corner(index, 0)), into(mesh.corner(index, 1)),
                            into(mesh.corner(index, 2)));
    if (!triangle.is_degenerate()) {
      triangles_.push_back(triangle);
      indices_.push_back(index);
    } else if (is_exact) {
      throw MeshError("cgal: triangle " + std::to_string(mesh.id(index)) +
                      " has no area, which kernel=epeck cannot project on");
    }
  }

  /// The closest of the mesh, or the end and some point when it is beyond the reach.
  Closest closest(const Point& center, const Vec3& at, double reach, std::uint32_t last) const {
    using Hint = CgalDetector::Hint;
    std::optional<Closest> start;
    if (last < triangles_.size() && options.hint != Hint::none) {
      const Triangle& triangle = triangles_[last];
      start.emplace(Kernel().construct_projected_point_3_object()(triangle, center),
                    triangles_.begin() + static_cast<std::ptrdiff_t>(last));
    }
    if (options.hint == Hint::bounded) {
      const Point limit = into(beyond(bounds, at, reach));
      if (!start || Kernel().compare_distance_3_object()(center, limit, start->first) == CGAL::SMALLER)
        start.emplace(limit, triangles_.end());
    }
    return start ? tree_.closest_point_and_primitive(center, *start)
                 : tree_.closest_point_and_primitive(center);
  }

  static double rounded_root(const FT& squared) { return std::sqrt(CGAL::to_double(settled(squared))); }
  static Point into(const Vec3& p) { return {p.x(), p.y(), p.z()}; }
  static Vec3 from(const Point& p) {
    return {CGAL::to_double(settled(p.x())), CGAL::to_double(settled(p.y())),
            CGAL::to_double(settled(p.z()))};
  }
  /// A lazy number rounds to the middle of the interval it knows; computed, to the nearest double or so.
  static const FT& settled(const FT& number) {
    if constexpr (is_exact) CGAL::exact(number);
    return number;
  }
  std::uint32_t index_of(Iterator triangle) const {
    return static_cast<std::uint32_t>(triangle - triangles_.begin());
  }

  std::vector<Triangle> triangles_;     // those of an area
  std::vector<std::uint32_t> indices_;  // which of the mesh they are
  Tree tree_;
};

}  // namespace

CgalDetector CgalDetector::build(const TriangleMesh& mesh, const Options& options) {
  switch (options.kernel) {
    case Kernel::simple:
      return CgalDetector(
          make_hidden<const Model, const TreeModel<CGAL::Simple_cartesian<double>>>(mesh, options));
    case Kernel::epeck:
      return CgalDetector(make_hidden<const Model, const TreeModel<CGAL::Epeck>>(mesh, options));
    case Kernel::epick:
      break;
  }
  return CgalDetector(make_hidden<const Model, const TreeModel<CGAL::Epick>>(mesh, options));
}

std::optional<Contact> CgalDetector::nearest(const Probe& probe, double reach,
                                             Session& session) const noexcept {
  const std::optional<double> finite = model_->reach_to_ask(probe.center, reach, session.last);
  if (!finite || std::isnan(reach)) return std::nullopt;
  const std::optional<Model::Found> found = model_->nearest(probe.center, *finite, session.last);
  if (!found && model_->checked()) session.last = no_triangle;
  if (!found) return std::nullopt;
  session.last = found->index;
  const double length = found->away.norm();
  const Vec3 normal = length > 0 ? Vec3(found->away / length) : model_->face_normal(found->index);
  return Contact{found->point, normal, found->distance, model_->ids[found->triangle]};
}

bool CgalDetector::touches(const Probe& probe, Session& session) const noexcept {
  const std::optional<double> radius = model_->reach_to_ask(probe.center, probe.radius, session.last);
  std::uint32_t none = no_triangle;
  return radius && !std::isnan(probe.radius) &&
         model_->touches({probe.center, *radius}, model_->checked() ? session.last : none);
}

std::size_t CgalDetector::bytes() const noexcept { return model_->tree_bytes() + model_->ids.bytes(); }

Accuracy CgalDetector::accuracy() const noexcept {
  if (model_->options.kernel == Kernel::epeck) {
    Accuracy accuracy = certified;
    accuracy.names_exactly = false;  // of ties it names any
    return accuracy;
  }
  return {Guarantee::approximate, std::numeric_limits<double>::infinity(), 0};
}

}  // namespace touchmark::baselines
