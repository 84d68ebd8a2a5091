#include "baselines/bullet/bullet_detector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <BulletCollision/CollisionDispatch/SphereTriangleDetector.h>
#include <BulletCollision/CollisionShapes/btOptimizedBvh.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <btBulletCollisionCommon.h>

#include "baselines/bullet/view.h"
#include "core/geometry/point_triangle.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/mesh_update.h"
#include "core/search/first_touch.h"

namespace touchmark::baselines {
namespace {

constexpr double scalar_roundoff = std::numeric_limits<btScalar>::epsilon() / 2;

Vec3 vec3(const btVector3& v) { return Vec3(v.x(), v.y(), v.z()); }
btVector3 bt_vector(const Vec3& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}
btTransform at(const btVector3& center) { return btTransform(btQuaternion::getIdentity(), center); }

/// In Bullet's numbers.
struct View : BulletView {
  btVector3 into(const Vec3& point) const { return bt_vector(BulletView::into(point)); }
  Vec3 back(const btVector3& point) const { return BulletView::back(vec3(point)); }
};

/// The deepest of the contacts that Bullet reports, in Bullet's frame.
class Deepest final : public btCollisionWorld::ContactResultCallback {
 public:
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int triangle) override {
    ++reported;
    // Bullet also reports what is apart by less than a tolerance of its own.
    if (point.getDistance() > 0) return 0;
    if (!found || std::pair(point.getDistance(), triangle) < std::pair(depth, index)) {
      found = true;
      depth = point.getDistance();
      index = triangle;
      on_mesh = point.getPositionWorldOnB();
      normal = point.m_normalWorldOnB;
    }
    return 0;
  }

  bool found = false;
  btScalar depth = 0;  ///< <= 0
  int index = 0;
  btVector3 on_mesh, normal;
  std::uint64_t reported = 0;
};

class FirstHit final : public btCollisionWorld::ConvexResultCallback {
 public:
  btScalar addSingleResult(btCollisionWorld::LocalConvexResult& result, bool) override {
    ++reported;
    m_closestHitFraction = result.m_hitFraction;
    point = result.m_hitPointLocal;
    index = result.m_localShapeInfo ? result.m_localShapeInfo->m_triangleIndex : 0;
    normal = result.m_hitNormalLocal;
    return result.m_hitFraction;
  }

  int index = 0;
  btVector3 point, normal;
  std::uint64_t reported = 0;
};

template <class Visit>
class Visitor final : public btNodeOverlapCallback {
 public:
  explicit Visitor(Visit visit) : visit_(std::move(visit)) {}
  void processNode(int, int triangle) override { visit_(static_cast<std::uint32_t>(triangle)); }

 private:
  Visit visit_;
};

/// What Bullet calls a world, for one haptic point: it needs a dispatcher to find the algorithm for a pair of
/// shapes, and objects that hold the shapes.
struct World {
  explicit World(btCollisionShape& mesh)
      : configuration(small_pools()), dispatcher(&configuration), world(&dispatcher, &pairs, &configuration) {
    mesh_object.setCollisionShape(&mesh);
    probe_object.setCollisionShape(&ball);
  }
  static btDefaultCollisionConstructionInfo small_pools() {
    btDefaultCollisionConstructionInfo info;
    info.m_defaultMaxPersistentManifoldPoolSize = 16;
    info.m_defaultMaxCollisionAlgorithmPoolSize = 16;
    return info;
  }

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher;
  btDbvtBroadphase pairs;
  btCollisionWorld world;
  btSphereShape ball{1};
  btCollisionObject mesh_object, probe_object;
};

}  // namespace

struct BulletDetector::Model : RivalModel<BulletDetector::Options> {
  Model(const TriangleMesh& mesh, const Options& chosen) : RivalModel(mesh, chosen), connectivity(mesh) {
    ids = mesh.triangle_ids();
    if (options.frame == Frame::fitted) view = {BulletView::fitted(mesh)};
    if (options.method == Method::callback) triangles = prepare(mesh);
    set_bounds(mesh);
    vertices.reserve(mesh.vertices().size());
    corners_of_bullet.reserve(3 * mesh.size());
    for (const Vec3& vertex : mesh.vertices()) vertices.push_back(view.into(vertex));
    for (const TriangleMesh::Corners& corners : mesh.triangles())
      for (const std::uint32_t corner : corners) corners_of_bullet.push_back(static_cast<int>(corner));
    arrays = std::make_unique<btTriangleIndexVertexArray>(
        static_cast<int>(mesh.size()), corners_of_bullet.data(), static_cast<int>(3 * sizeof(int)),
        static_cast<int>(vertices.size()), reinterpret_cast<btScalar*>(vertices.data()),
        static_cast<int>(sizeof(btVector3)));
    // A quantised node keeps 21 bits for the triangle, and more of them crash it.
    constexpr std::size_t quantisable = std::size_t{1} << (31 - MAX_NUM_PARTS_IN_BITS);
    shape = std::make_unique<btBvhTriangleMeshShape>(arrays.get(), mesh.size() <= quantisable);
  }

  void set_bounds(const TriangleMesh& mesh) {
    bounds = mesh.bounds();
    largest_coordinate =
        view.scale *
        (bounds.min - view.origin).cwiseAbs().cwiseMax((bounds.max - view.origin).cwiseAbs()).maxCoeff();
  }

  void update(const TriangleMesh& mesh) {
    set_bounds(mesh);
    follow(mesh);
    for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i] = view.into(mesh.vertices()[i]);
    btVector3 low, high;
    arrays->calculateAabbBruteForce(low, high);
    shape->refitTree(low, high);
    // A hierarchy that is not quantised stays as it was, without a word.
    if (!shape->usesQuantizedAabbCompression()) shape->buildOptimizedBvh();
  }

  /// Calls visit(triangle) for every triangle that may come as near as `reach` to the segment. Bullet rounds
  /// vertices and boxes to its own precision; what it does with them then is monotone.
  template <class Visit>
  void near(const Vec3& from, const Vec3& to, double reach, Visit visit) const {
    const Vec3 low = view.scale * (from.cwiseMin(to) - Vec3::Constant(reach) - view.origin);
    const Vec3 high = view.scale * (from.cwiseMax(to) + Vec3::Constant(reach) - view.origin);
    const double largest =
        std::max({largest_coordinate, low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff()});
    // One rounding of a vertex, one of a corner of the box, and as much again for doubles' own.
    const Vec3 pad = Vec3::Constant(4 * scalar_roundoff * largest);
    Visitor<Visit> visitor(std::move(visit));
    shape->getOptimizedBvh()->reportAabbOverlappingNodex(&visitor, bt_vector(low - pad),
                                                         bt_vector(high + pad));
  }

  Connectivity connectivity;
  View view;
  double largest_coordinate = 0;  ///< in Bullet's frame
  std::vector<btVector3> vertices;
  std::vector<int> corners_of_bullet;
  std::unique_ptr<btTriangleIndexVertexArray> arrays;
  std::unique_ptr<btBvhTriangleMeshShape> shape;
};

struct BulletDetector::State : World {
  using World::World;
};

BulletDetector::State& BulletDetector::state(Session& session) const {
  if (!session.state || session.state->mesh_object.getCollisionShape() != model_->shape.get()) {
    session.state = make_hidden<State>(*model_->shape);
    session.last = no_triangle;
  }
  return *session.state;
}

BulletDetector::Precision BulletDetector::precision() noexcept {
  return sizeof(btScalar) == sizeof(double) ? Precision::double_precision : Precision::single_precision;
}

namespace {

/// Bullet's contact test of the ball with the mesh.
Deepest contact_test(World& world, const View& view, const Vec3& center, double radius) {
  world.ball.setUnscaledRadius(static_cast<btScalar>(view.scale * radius));
  world.probe_object.setWorldTransform(at(view.into(center)));
  Deepest deepest;
  world.world.contactPairTest(&world.probe_object, &world.mesh_object, deepest);
  return deepest;
}

Vec3 direction(const Vec3& from, const Vec3& to, const btVector3& otherwise) {
  const Vec3 direction = to - from;
  const double length = direction.norm();
  return length > 0 ? Vec3(direction / length) : vec3(otherwise).normalized();
}

}  // namespace

/// The queries, method by method.
struct BulletDetector::Queries {
  const Model& model;
  Session& session;
  State& state;

  std::optional<Contact> deepest_contact(const Vec3& center, double reach) const {
    const Deepest deepest = contact_test(state, model.view, center, reach);
    session.work.triangles += deepest.reported;
    session.last = deepest.found ? static_cast<std::uint32_t>(deepest.index) : no_triangle;
    if (!deepest.found) return std::nullopt;
    const Vec3 point = model.view.back(deepest.on_mesh);
    const double distance = std::max(0.0, reach + static_cast<double>(deepest.depth) / model.view.scale);
    return Contact{point, direction(point, center, deepest.normal), distance,
                   model.ids[static_cast<std::size_t>(deepest.index)]};
  }

  /// Bullet's narrow phase for the triangle of the last contact: what its contact test comes to for each one.
  bool touches_last(const Vec3& center, double radius) const {
    if (!model.checked() || session.last >= model.corners_of_bullet.size() / 3) return false;
    const auto corner = [&](std::size_t i) {
      return model
          .vertices[static_cast<std::size_t>(model.corners_of_bullet[3 * std::size_t{session.last} + i])];
    };
    ++session.work.triangles;
    state.ball.setUnscaledRadius(static_cast<btScalar>(model.view.scale * radius));
    btTriangleShape triangle(corner(0), corner(1), corner(2));
    SphereTriangleDetector narrow(&state.ball, &triangle, 0);
    btVector3 point, normal;
    btScalar depth = 0, time = 0;
    return narrow.collide(model.view.into(center), point, normal, depth, time, 0) && depth <= 0;
  }

  bool touches(const Vec3& center, double radius) const {
    if (model.options.method == Method::contact)
      return touches_last(center, radius) || deepest_contact(center, radius).has_value();
    return model.checked() ? touches_any(center, radius)
                           : std::sqrt(reported_within(center, radius).squared_distance) <= radius;
  }

  /// Bullet's traversal cannot be ended, but what it reports after the first touch is not measured.
  bool touches_any(const Vec3& center, double radius) const {
    const auto touches = [&](std::uint32_t triangle) {
      ++session.work.triangles;
      return std::sqrt(squared_distance(model.triangles[triangle], center)) <= radius;
    };
    if (session.last < model.triangles.size() && touches(session.last)) return true;
    session.last = no_triangle;
    model.near(center, center, radius, [&](std::uint32_t triangle) {
      if (session.last == no_triangle && touches(triangle)) session.last = triangle;
    });
    return session.last != no_triangle;
  }

  /// The least candidate of the triangles that Bullet reports within the reach.
  Candidate reported_within(const Vec3& center, double reach) const {
    Candidate best;
    model.near(center, center, reach, [&](std::uint32_t triangle) {
      ++session.work.triangles;
      best = std::min(best, Candidate{squared_distance(model.triangles[triangle], center), triangle});
    });
    return best;
  }

  std::optional<Contact> exact_contact(const Vec3& center, double reach) const {
    const Candidate best = reported_within(center, reach);
    if (best.index >= model.triangles.size() || !(std::sqrt(best.squared_distance) <= reach))
      return std::nullopt;
    session.last = best.index;
    return contact_on(model.triangles[best.index], center, model.ids[best.index]);
  }

  /// The last triangle's distance bounds the nearest one's.
  double warm_reach(const Vec3& center, double reach) const {
    if (model.checked() && session.last >= model.triangles.size()) return reach;
    const std::uint32_t last = session.last < model.triangles.size() ? session.last : 0;
    ++session.work.triangles;
    return std::min(reach, std::sqrt(squared_distance(model.triangles[last], center)));
  }

  std::optional<Contact> nearest(const Vec3& center, double reach) const {
    if (model.options.method == Method::callback) {
      const std::optional<Contact> contact =
          nearest_by_growing(model.bounds, center, warm_reach(center, reach),
                             [&](double within) { return exact_contact(center, within); });
      if (model.checked() && !contact) session.last = no_triangle;
      return contact;
    }
    return nearest_by_growing(model.bounds, center, reach,
                              [&](double within) { return deepest_contact(center, within); });
  }

  /// Bullet's sweep is for what starts apart: from a start in contact it finds nothing, or something later.
  std::optional<Impact> convex_sweep(const Sweep& sweep) const {
    if (std::optional<Contact> contact = deepest_contact(sweep.from, sweep.radius))
      return Impact{0, *std::move(contact)};
    state.ball.setUnscaledRadius(static_cast<btScalar>(model.view.scale * sweep.radius));
    FirstHit hit;
    btCollisionWorld::objectQuerySingle(&state.ball, at(model.view.into(sweep.from)),
                                        at(model.view.into(sweep.to)), &state.mesh_object, model.shape.get(),
                                        btTransform::getIdentity(), hit, 0);
    session.work.triangles += hit.reported;
    if (!hit.hasHit()) return std::nullopt;
    const double fraction = std::clamp(static_cast<double>(hit.m_closestHitFraction), 0.0, 1.0);
    const Vec3 center = position_at(sweep, fraction);
    const Vec3 point = model.view.back(hit.point);
    return Impact{fraction, Contact{point, direction(point, center, hit.normal), (center - point).norm(),
                                    model.ids[static_cast<std::size_t>(hit.index)]}};
  }

  std::optional<Impact> exact_sweep(const Sweep& sweep) const {
    FirstTouch first(sweep);
    model.near(sweep.from, sweep.to, sweep.radius, [&](std::uint32_t triangle) {
      ++session.work.triangles;
      first.consider(model.triangles[triangle], session.work.exact_decisions);
    });
    return impact_of(first, model.ids, false, [&](double reach) { return nearest(sweep.from, reach); });
  }
};

BulletDetector BulletDetector::build(const TriangleMesh& mesh, const Options& options) {
  require_int_counts("Bullet", mesh);
  return BulletDetector(make_hidden<Model>(mesh, options));
}

void BulletDetector::update(const TriangleMesh& mesh) {
  model_->connectivity.expect(mesh);
  model_->update(mesh);
}

bool BulletDetector::touches(const Probe& probe, Session& session) const noexcept {
  const std::optional<double> radius = model_->reach_to_ask(probe.center, probe.radius, session.last);
  return radius && Queries{*model_, session, state(session)}.touches(probe.center, *radius);
}

std::optional<Contact> BulletDetector::nearest(const Probe& probe, double reach,
                                               Session& session) const noexcept {
  const std::optional<double> finite = model_->reach_to_ask(probe.center, reach, session.last);
  if (!finite) return std::nullopt;
  return Queries{*model_, session, state(session)}.nearest(probe.center, *finite);
}

std::optional<Impact> BulletDetector::first_hit(const Sweep& asked, Session& session) const noexcept {
  if (model_->checked() && out_of_reach(model_->bounds, asked)) return std::nullopt;
  const Sweep sweep{asked.from, asked.to, finite_reach(model_->bounds, asked.from, asked.radius)};
  if (!answerable(sweep.from, sweep.radius) || !answerable(sweep.to, 0)) return std::nullopt;
  const Queries ask{*model_, session, state(session)};
  return model_->options.method == Method::callback ? ask.exact_sweep(sweep) : ask.convex_sweep(sweep);
}

std::size_t BulletDetector::bytes() const noexcept {
  return model_->shape->getOptimizedBvh()->calculateSerializeBufferSize() +
         model_->vertices.capacity() * sizeof(btVector3) +
         model_->corners_of_bullet.capacity() * sizeof(int) + model_->own_bytes();
}

Accuracy BulletDetector::accuracy() const noexcept {
  if (model_->options.method == Method::callback) return {Guarantee::exact, kernel_relative_error, 0};
  // What Bullet's arithmetic would give if it did what it is meant to: a few dozen roundings of differences,
  // one of each coordinate.
  const double coordinates = 4 * scalar_roundoff * model_->largest_coordinate / model_->view.scale;
  return {Guarantee::approximate, 64 * scalar_roundoff, coordinates};
}

}  // namespace touchmark::baselines
