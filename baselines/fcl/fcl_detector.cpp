#include "baselines/fcl/fcl_detector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>
#include <fcl/narrowphase/detail/traversal/collision/mesh_shape_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>
#include <fcl/narrowphase/detail/traversal/distance/mesh_shape_distance_traversal_node.h>
#include <fcl/narrowphase/distance.h>

#include "core/geometry/point_triangle.h"
#include "core/mesh_update.h"

namespace touchmark::baselines {
namespace {

using Solver = fcl::detail::GJKSolver_libccd<double>;
using Sphere = fcl::Sphered;
namespace nodes = fcl::detail;

fcl::Transform3d at(const Vec3& center) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = center;
  return pose;
}

/// FCL's traversals for each volume, and the ball as that volume. FCL itself fits kIOS and RSS to the twelve
/// corners of an icosahedron about the sphere, every query; the ball itself is one of either, and tighter.
template <class Bounds>
struct Traversal;

template <>
struct Traversal<fcl::AABBd> {
  using Collide = nodes::MeshShapeCollisionTraversalNode<fcl::AABBd, Sphere, Solver>;
  using Distance = nodes::MeshShapeDistanceTraversalNode<fcl::AABBd, Sphere, Solver>;
  static void set_ball(fcl::AABBd& box, const Vec3& center, double radius) {
    box.min_ = center - Vec3::Constant(radius);
    box.max_ = center + Vec3::Constant(radius);
  }
};

template <>
struct Traversal<fcl::OBBd> {
  using Collide = nodes::MeshShapeCollisionTraversalNodeOBB<Sphere, Solver>;
  using Distance = void;  // FCL has no distance between OBBs
  static void set_ball(fcl::OBBd& box, const Vec3& center, double radius) {
    box.axis.setIdentity();
    box.To = center;
    box.extent.setConstant(radius);
  }
};

template <>
struct Traversal<fcl::RSSd> {
  using Collide = nodes::MeshShapeCollisionTraversalNodeRSS<Sphere, Solver>;
  using Distance = nodes::MeshShapeDistanceTraversalNodeRSS<Sphere, Solver>;
  static void set_ball(fcl::RSSd& volume, const Vec3& center, double radius) {
    volume.axis.setIdentity();
    volume.To = center;
    volume.l[0] = volume.l[1] = 0;
    volume.r = radius;
  }
};

template <>
struct Traversal<fcl::OBBRSSd> {
  using Collide = nodes::MeshShapeCollisionTraversalNodeOBBRSS<Sphere, Solver>;
  using Distance = nodes::MeshShapeDistanceTraversalNodeOBBRSS<Sphere, Solver>;
  static void set_ball(fcl::OBBRSSd& volume, const Vec3& center, double radius) {
    Traversal<fcl::OBBd>::set_ball(volume.obb, center, radius);
    Traversal<fcl::RSSd>::set_ball(volume.rss, center, radius);
  }
};

template <>
struct Traversal<fcl::kIOSd> {
  using Collide = nodes::MeshShapeCollisionTraversalNodekIOS<Sphere, Solver>;
  using Distance = nodes::MeshShapeDistanceTraversalNodekIOS<Sphere, Solver>;
  static void set_ball(fcl::kIOSd& volume, const Vec3& center, double radius) {
    volume.num_spheres = 1;
    volume.spheres[0].o = center;
    volume.spheres[0].r = radius;
    Traversal<fcl::OBBd>::set_ball(volume.obb, center, radius);
  }
};

/// FCL's collision traversal with our kernel at the leaves: the nearest of the triangles whose volumes meet
/// the ball's, or for a touching test the first that touches.
template <class Base>
class ExactCollide : public Base {
 public:
  enum class Stop { at_first_touch, never };

  ExactCollide(const std::vector<PreparedTriangle>& triangles, const Probe& probe, Stop stop)
      : triangles_(triangles), probe_(probe), stop_(stop) {}

  void leafTesting(int leaf, int) const override {
    ++this->num_leaf_tests;
    const auto triangle = static_cast<std::uint32_t>(this->model1->getBV(leaf).primitiveId());
    best_ = std::min(best_, Candidate{squared_distance(triangles_[triangle], probe_.center), triangle});
  }
  bool canStop() const override { return stop_ == Stop::at_first_touch && touching(); }
  bool touching() const { return std::sqrt(best_.squared_distance) <= probe_.radius; }
  const Candidate& best() const { return best_; }

 private:
  const std::vector<PreparedTriangle>& triangles_;
  const Probe& probe_;
  Stop stop_;
  mutable Candidate best_;
};

/// FCL's best-first descent with our kernel at the leaves. Volumes as near as the best so far are entered, so
/// that of several nearest triangles the lowest wins whatever the order; `first` is where to start, if any.
template <class Base>
class ExactNearest : public Base {
 public:
  ExactNearest(const std::vector<PreparedTriangle>& triangles, const Vec3& center, double reach, double slack,
               std::uint32_t first)
      : triangles_(triangles), center_(center), bound_(reach), slack_(slack), first_(first) {}

  void preprocess() override {
    if (first_ < triangles_.size()) consider(first_);
  }
  void postprocess() override {}
  void leafTesting(int leaf, int) const override {
    ++this->num_leaf_tests;
    consider(static_cast<std::uint32_t>(this->model1->getBV(leaf).primitiveId()));
  }
  bool canStop(double volume_distance) const override { return volume_distance - slack_ > bound_; }
  const Candidate& best() const { return best_; }

 private:
  void consider(std::uint32_t triangle) const {
    best_ = std::min(best_, Candidate{squared_distance(triangles_[triangle], center_), triangle});
    bound_ = std::min(bound_, std::sqrt(best_.squared_distance));
  }

  const std::vector<PreparedTriangle>& triangles_;
  const Vec3& center_;
  mutable Candidate best_;
  mutable double bound_;
  double slack_;
  std::uint32_t first_;
};

/// FCL's distance traversal as it stands, but for one fault: where the point lies on a triangle FCL's leaf
/// test leaves the distance unset and compares it all the same. Here it is zero.
template <class Base>
class FclNearest : public Base {
 public:
  void leafTesting(int leaf, int) const override {
    ++this->num_leaf_tests;
    consider(this->model1->getBV(leaf).primitiveId());
  }
  void preprocess() override {}
  void postprocess() override {}

  struct Measured {
    double distance;
    Vec3 on_mesh, on_ball;
  };
  Measured measured(int triangle) const {
    const fcl::Triangle& corner = this->tri_indices[triangle];
    const Vec3 center = this->tf2.translation();
    Measured found{0, center, center};
    const bool apart = this->nsolver->shapeTriangleDistance(
        *this->model2, this->tf2, this->vertices[corner[0]], this->vertices[corner[1]],
        this->vertices[corner[2]], this->tf1, &found.distance, &found.on_ball, &found.on_mesh);
    if (!apart) {
      found.distance = 0;
      found.on_mesh = center;
    }
    return found;
  }

 private:
  void consider(int triangle) const {
    const auto [distance, on_mesh, on_ball] = measured(triangle);
    this->result->update(distance, this->model1, this->model2, triangle, fcl::DistanceResultd::NONE, on_mesh,
                         on_ball);
  }
};

/// How far FCL's fitted volumes may fall short of what they hold. FCL computes them in absolute coordinates
/// with a few dozen roundings (covariance, eigenvectors, projections); 2^12 of them is a generous allowance,
/// not a proof.
double fitting_slack(double largest_coordinate, const Vec3& center) {
  return 0x1p-40 * std::max(largest_coordinate, center.cwiseAbs().maxCoeff());
}

}  // namespace

struct FclDetector::State {
  fcl::CollisionResultd contacts;
  Solver solver;
};

struct FclDetector::Model : RivalModel<FclDetector::Options> {
  Connectivity connectivity;
  double largest_coordinate = 0;

  Model(const TriangleMesh& mesh, const Options& chosen) : RivalModel(mesh, chosen), connectivity(mesh) {
    ids = mesh.triangle_ids();
    set_bounds(mesh);
    if (options.narrow == Narrow::exact) triangles = prepare(mesh);
  }
  virtual ~Model() = default;
  void set_bounds(const TriangleMesh& mesh) {
    bounds = mesh.bounds();
    largest_coordinate = baselines::largest_coordinate(bounds);
  }
  virtual void replace_vertices(const TriangleMesh& mesh) = 0;
  virtual bool touches(const Probe& probe, Session& session) const = 0;
  virtual std::optional<Contact> nearest(const Vec3& center, double reach, Session& session) const = 0;
  virtual std::size_t hierarchy_bytes() const = 0;
};

template <class Bounds>
struct FclDetector::ModelOf : FclDetector::Model {
  using Collide = typename Traversal<Bounds>::Collide;
  using Distance = typename Traversal<Bounds>::Distance;
  using Gather = ExactCollide<Collide>;
  static constexpr bool has_distance = !std::is_void_v<Distance>;

  ModelOf(const TriangleMesh& mesh, const Options& chosen) : Model(mesh, chosen) {
    if (!has_distance && options.method == Method::distance)
      throw std::invalid_argument("fcl: method=distance does not work with bv=obb");
    std::vector<fcl::Triangle> triangles_of_fcl;
    triangles_of_fcl.reserve(mesh.size());
    for (const TriangleMesh::Corners& corners : mesh.triangles())
      triangles_of_fcl.emplace_back(corners[0], corners[1], corners[2]);
    const std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
    const int begun = hierarchy.beginModel(static_cast<int>(mesh.size()), static_cast<int>(vertices.size()));
    const int added = hierarchy.addSubModel(vertices, triangles_of_fcl);
    finish("mesh", {begun, added, hierarchy.endModel()});
  }

  void replace_vertices(const TriangleMesh& mesh) override {
    const std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
    const int begun = hierarchy.beginReplaceModel();
    const int replaced = hierarchy.replaceSubModel(vertices);
    // From the leaves up FCL adds volumes, and the sums of all but boxes do not hold what their parts hold.
    const bool from_leaves = options.bv == Volume::aabb;
    finish("vertices", {begun, replaced, hierarchy.endReplaceModel(true, from_leaves)});
  }
  void finish(const std::string& given, std::initializer_list<int> statuses) {
    for (const int status : statuses)
      if (status != fcl::BVH_OK)
        throw MeshError("FCL refuses the " + given + " with status " + std::to_string(status));
    hierarchy.computeLocalAABB();
  }

  bool touches(const Probe& probe, Session& session) const override {
    if (touches_last(probe, session)) {
      ++session.work.triangles;
      return true;
    }
    session.last = no_triangle;
    if (options.narrow == Narrow::exact) {
      const Candidate best = collided(probe, Gather::Stop::at_first_touch, session);
      const bool touching = std::sqrt(best.squared_distance) <= probe.radius;
      if (touching) session.last = best.index;
      return touching;
    }
    const Sphere ball(probe.radius);
    fcl::CollisionRequestd request(1, false);
    if (collide(ball, probe.center, request, session) == 0) return false;
    session.last = static_cast<std::uint32_t>(session.state->contacts.getContact(0).b1);
    return true;
  }

  /// By the narrow phase that the traversal has at its leaves.
  bool touches_last(const Probe& probe, Session& session) const {
    if (!checked() || session.last >= static_cast<std::uint32_t>(hierarchy.num_tris)) return false;
    if (options.narrow == Narrow::exact)
      return std::sqrt(squared_distance(triangles[session.last], probe.center)) <= probe.radius;
    const fcl::Triangle& corner = hierarchy.tri_indices[session.last];
    return session.ready().solver.shapeTriangleIntersect(
        Sphere(probe.radius), at(probe.center), hierarchy.vertices[corner[0]], hierarchy.vertices[corner[1]],
        hierarchy.vertices[corner[2]], fcl::Transform3d::Identity(), nullptr, nullptr, nullptr);
  }

  std::optional<Contact> nearest(const Vec3& center, double reach, Session& session) const override {
    if (options.method != Method::distance)
      return options.narrow == Narrow::exact ? exact_deepest(center, reach, session)
                                             : deepest_contact(center, reach, session);
    if constexpr (has_distance)
      return options.narrow == Narrow::exact ? exact_nearest(center, reach, session)
                                             : bounded_distance(center, reach, session);
    return std::nullopt;
  }

  /// FCL's own collision, with the public function or by the same traversal without its dispatcher.
  std::size_t collide(const Sphere& ball, const Vec3& center, const fcl::CollisionRequestd& request,
                      Session& session) const {
    State& state = session.ready();
    state.contacts.clear();
    if (options.method == Method::collide) {
      fcl::collide(&hierarchy, fcl::Transform3d::Identity(), &ball, at(center), request, state.contacts);
      session.work.triangles += state.contacts.numContacts();
    } else {
      Collide node;
      set_up(node, ball, center, session);
      node.request = request;
      node.result = &state.contacts;
      nodes::collide(&node, nullptr);
      count(node, session);
    }
    return state.contacts.numContacts();
  }

  std::optional<Contact> deepest_contact(const Vec3& center, double reach, Session& session) const {
    const Sphere ball(reach);
    const fcl::CollisionRequestd request(std::numeric_limits<std::size_t>::max(), true);
    const std::size_t found = collide(ball, center, request, session);
    const fcl::CollisionResultd& contacts = session.ready().contacts;
    const auto key = [](const fcl::Contactd& contact) {
      return std::pair(contact.penetration_depth, contact.b1);  // the depth comes negative
    };
    const fcl::Contactd* deepest = nullptr;
    for (std::size_t i = 0; i < found; ++i) {
      const fcl::Contactd& contact = contacts.getContact(i);
      if (!deepest || key(contact) < key(*deepest)) deepest = &contact;
    }
    session.last = deepest ? static_cast<std::uint32_t>(deepest->b1) : no_triangle;
    if (!deepest) return std::nullopt;
    const double distance = std::max(0.0, reach + deepest->penetration_depth);
    return Contact{deepest->pos, deepest->normal, distance, ids[static_cast<std::size_t>(deepest->b1)]};
  }

  /// The ball need not hold more than the last triangle's distance.
  std::optional<Contact> exact_deepest(const Vec3& center, double reach, Session& session) const {
    double within = reach;
    if (checked() && session.last < triangles.size())
      within = std::min(reach, std::sqrt(squared_distance(triangles[session.last], center)));
    const Candidate best = collided({center, within}, Gather::Stop::never, session);
    const std::optional<Contact> contact = exact_contact(best, center, within);
    session.last = contact ? best.index : no_triangle;
    return contact;
  }

  Candidate collided(const Probe& probe, typename Gather::Stop stop, Session& session) const {
    Gather node(triangles, probe, stop);
    const Sphere ball(probe.radius);
    set_up(node, ball, probe.center, session);
    Traversal<Bounds>::set_ball(node.model2_bv, probe.center,
                                probe.radius + fitting_slack(largest_coordinate, probe.center));
    nodes::collide(&node, nullptr);
    count(node, session);
    return node.best();
  }

  std::optional<Contact> bounded_distance(const Vec3& center, double reach, Session& session) const {
    FclNearest<Distance> node;
    const Sphere point(0);
    set_up(node, point, center, session);
    Traversal<Bounds>::set_ball(node.model2_bv, center, 0);
    // Only what is nearer than the bound counts for FCL; contact here is closed. The last triangle's distance
    // bounds the search with more room than FCL's roundings take: which triangle FCL finds does not change.
    double bound = reach;
    if (checked() && session.last < static_cast<std::uint32_t>(hierarchy.num_tris))
      bound = std::min(bound, node.measured(static_cast<int>(session.last)).distance +
                                  fitting_slack(largest_coordinate, center));
    fcl::DistanceResultd result(std::nextafter(bound, std::numeric_limits<double>::infinity()));
    node.result = &result;
    nodes::distance(&node, nullptr, 2);
    count(node, session);
    const bool found = result.b1 != fcl::DistanceResultd::NONE;
    session.last = found ? static_cast<std::uint32_t>(result.b1) : no_triangle;
    if (!found) return std::nullopt;
    const Vec3 offset = center - result.nearest_points[0];
    const double length = offset.norm();
    const Vec3 normal = length > 0 ? Vec3(offset / length) : face_normal(static_cast<int>(result.b1));
    return Contact{result.nearest_points[0], normal, result.min_distance,
                   ids[static_cast<std::size_t>(result.b1)]};
  }

  std::optional<Contact> exact_nearest(const Vec3& center, double reach, Session& session) const {
    const bool always = !checked();
    ExactNearest<Distance> node(triangles, center, reach, fitting_slack(largest_coordinate, center),
                                always && session.last >= triangles.size() ? 0 : session.last);
    const Sphere point(0);
    set_up(node, point, center, session);
    Traversal<Bounds>::set_ball(node.model2_bv, center, 0);
    nodes::distance(&node, nullptr, 2);
    count(node, session);
    const std::optional<Contact> contact = exact_contact(node.best(), center, reach);
    if (contact || always) session.last = node.best().index;
    if (!contact && !always) session.last = no_triangle;
    return contact;
  }

  std::optional<Contact> exact_contact(const Candidate& best, const Vec3& center, double reach) const {
    if (best.index >= triangles.size() || !(std::sqrt(best.squared_distance) <= reach)) return std::nullopt;
    return contact_on(triangles[best.index], center, ids[best.index]);
  }

  Vec3 face_normal(int triangle) const {
    const fcl::Triangle& corner = hierarchy.tri_indices[triangle];
    const Vec3& a = hierarchy.vertices[corner[0]];
    return (hierarchy.vertices[corner[1]] - a).cross(hierarchy.vertices[corner[2]] - a).normalized();
  }

  template <class Node>
  void set_up(Node& node, const Sphere& ball, const Vec3& center, Session& session) const {
    node.model1 = &hierarchy;
    node.tf1 = fcl::Transform3d::Identity();
    node.model2 = &ball;
    node.tf2 = at(center);
    node.nsolver = &session.ready().solver;
    node.vertices = hierarchy.vertices;
    node.tri_indices = hierarchy.tri_indices;
    node.enable_statistics = true;
    fcl::computeBV(ball, node.tf2, node.model2_bv);
  }

  template <class Node>
  static void count(const Node& node, Session& session) {
    session.work.boxes += static_cast<std::uint64_t>(node.num_bv_tests);
    session.work.triangles += static_cast<std::uint64_t>(node.num_leaf_tests);
  }

  std::size_t hierarchy_bytes() const override {
    return sizeof(fcl::BVNode<Bounds>) * static_cast<std::size_t>(hierarchy.getNumBVs()) +
           (sizeof(fcl::Triangle) + sizeof(unsigned)) * static_cast<std::size_t>(hierarchy.num_tris) +
           sizeof(Vec3) * static_cast<std::size_t>(hierarchy.num_vertices);
  }

  fcl::BVHModel<Bounds> hierarchy;
};

FclDetector FclDetector::build(const TriangleMesh& mesh, const Options& options) {
  require_int_counts("FCL", mesh);
  if (options.method == Method::collide && options.narrow == Narrow::exact)
    throw std::invalid_argument("fcl: narrow=exact needs method=traverse or method=distance");
  switch (options.bv) {
    case Volume::kios:
      return FclDetector(make_hidden<Model, ModelOf<fcl::kIOSd>>(mesh, options));
    case Volume::obbrss:
      return FclDetector(make_hidden<Model, ModelOf<fcl::OBBRSSd>>(mesh, options));
    case Volume::obb:
      return FclDetector(make_hidden<Model, ModelOf<fcl::OBBd>>(mesh, options));
    case Volume::rss:
      return FclDetector(make_hidden<Model, ModelOf<fcl::RSSd>>(mesh, options));
    case Volume::aabb:
      return FclDetector(make_hidden<Model, ModelOf<fcl::AABBd>>(mesh, options));
  }
  throw std::invalid_argument("fcl: no such bv");
}

void FclDetector::update(const TriangleMesh& mesh) {
  model_->connectivity.expect(mesh);
  model_->set_bounds(mesh);
  model_->follow(mesh);
  model_->replace_vertices(mesh);
}

bool FclDetector::touches(const Probe& probe, Session& session) const noexcept {
  const std::optional<double> radius = model_->reach_to_ask(probe.center, probe.radius, session.last);
  if (!radius) return false;
  try {
    return model_->touches({probe.center, *radius}, session);
  } catch (...) {  // out of memory or FCL's own: it has found no contact
    return false;
  }
}

std::optional<Contact> FclDetector::nearest(const Probe& probe, double reach,
                                            Session& session) const noexcept {
  const std::optional<double> finite = model_->reach_to_ask(probe.center, reach, session.last);
  if (!finite) return std::nullopt;
  try {
    return model_->nearest(probe.center, *finite, session);
  } catch (...) {
    return std::nullopt;
  }
}

std::size_t FclDetector::bytes() const noexcept { return model_->hierarchy_bytes() + model_->own_bytes(); }

Accuracy FclDetector::accuracy() const noexcept {
  // A box of doubles is its triangles' own minima and maxima, so only there nothing can get lost.
  const Guarantee guarantee = model_->options.bv == Volume::aabb ? Guarantee::exact : Guarantee::approximate;
  if (model_->options.narrow == Narrow::exact) return {guarantee, kernel_relative_error, 0};
  // What its arithmetic would give if it did what it is meant to: a few dozen roundings, and the epsilon that
  // FCL adds to every radius.
  return {Guarantee::approximate, 0x1p-44, std::numeric_limits<double>::epsilon()};
}

}  // namespace touchmark::baselines
