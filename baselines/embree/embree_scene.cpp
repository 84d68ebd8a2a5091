#include "baselines/embree/embree_scene.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#if TOUCHMARK_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "baselines/embree/frame.h"
#include "baselines/embree/rounding.h"
#include "core/geometry/point_triangle.h"

namespace touchmark::baselines {
namespace {

/// The triangles of one shape, and Embree's scene of them about the middle of their box.
struct ShapeScene {
  std::vector<PreparedTriangle> triangles;
  TriangleIds ids;
  Aabb bounds;
  Vec3 center;
  double scale = 1;
  RTCScene scene = nullptr;
};

Aabb start_box(const PosedScene& scene) {
  Aabb box;
  for (const PosedScene::Body& body : scene.bodies) {
    const Aabb own = image_of_box(body.pose, scene.shapes[body.shape]->bounds());
    box.extend(own.min);
    box.extend(own.max);
  }
  return box;
}

}  // namespace

struct EmbreeScene::World {
  World(const PosedScene& scene, const EmbreeDetector::Options& chosen)
      : options(chosen), bounds(start_box(scene)), frame(bounds), bodies(scene.bodies) {}
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World() {
    if (top != nullptr) rtcReleaseScene(top);
    for (const std::unique_ptr<ShapeScene>& shape : shapes)
      if (shape->scene != nullptr) rtcReleaseScene(shape->scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  void expect_no_error() const {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE)
      throw MeshError("Embree failed with error " + std::to_string(static_cast<int>(error)));
  }
  void start();
  void add_shape(const TriangleMesh& mesh);
  void add_instance(std::uint32_t body);
  /// Gives Embree the body's transform, whose rotation and translation it keeps in single precision.
  void set_transform(std::uint32_t body, RTCGeometry instance);
  /// By how much a distance in the frame may come out wrong: EmbreeFrame::slack's roundings, and as many
  /// again for the transform, its inverse, which Embree computes, and the point that goes through it.
  double slack(const Vec3& p) const noexcept {
    return 4 * (EmbreeFrame::slack(p) + EmbreeFrame::slack(largest));
  }

  EmbreeDetector::Options options;
  Aabb bounds;  ///< holds all places where a body has been
  EmbreeFrame frame;
  std::vector<PosedScene::Body> bodies;
  std::vector<std::unique_ptr<ShapeScene>> shapes;
  Vec3 largest = Vec3::Zero();  ///< coordinates in the frame that a body has had
  double largest_of_shapes = 0;
  std::atomic<std::ptrdiff_t> taken{0};  // bytes
  RTCDevice device = nullptr;
  RTCScene top = nullptr;
};

/// The callbacks that Embree calls, and what they share with the query.
struct EmbreeSceneCallbacks {
  static void bounds_of(const RTCBoundsFunctionArguments* arguments) {
    const auto& shape = *static_cast<const ShapeScene*>(arguments->geometryUserPtr);
    Aabb box;
    for (const Vec3& corner : shape.triangles[arguments->primID].corner)
      box.extend(shape.scale * (corner - shape.center));
    set_bounds(*arguments->bounds_o, box);
  }

  struct Search {
    Search(const EmbreeScene::World& asked, const Vec3& point)
        : world(asked),
          center(point),
          in_scene_frame(asked.frame.into(point)),
          slack(asked.slack(in_scene_frame)) {}

    bool consider(std::uint32_t of, std::uint32_t triangle) noexcept {
      if (of != seen_body) {
        seen_body = of;
        seen = in_frame(world.bodies[of].pose, center);
      }
      ++tested;
      const ShapeScene& shape = *world.shapes[world.bodies[of].shape];
      const Candidate candidate{squared_distance(shape.triangles[triangle], seen), triangle};
      const bool nearer = candidate.squared_distance < best.squared_distance ||
                          (candidate.squared_distance == best.squared_distance &&
                           std::pair(of, triangle) < std::pair(body, best.index));
      if (!nearer) return false;
      best = candidate;
      body = of;
      return true;
    }
    double distance() const noexcept { return std::sqrt(best.squared_distance); }
    float radius(double reach) const noexcept { return rounded_up(world.frame.scale * reach + slack); }

    const EmbreeScene::World& world;
    const Vec3& center;
    Vec3 in_scene_frame;
    double slack;
    Candidate best;
    std::uint32_t body = no_triangle;
    std::uint32_t seen_body = no_triangle;
    Vec3 seen;  ///< the centre in the frame of the body that was asked last
    std::uint64_t tested = 0;
  };

  static bool nearest(RTCPointQueryFunctionArguments* arguments) {
    auto& search = *static_cast<Search*>(arguments->userPtr);
    if (!search.consider(arguments->context->instID[0], arguments->primID)) return false;
    const float radius = search.radius(search.distance());
    if (!(radius < arguments->query->radius)) return false;
    arguments->query->radius = radius;
    return true;
  }
};

void EmbreeScene::World::start() {
  // One thread, as everybody else builds with; and the caller's floating-point modes stay as they are.
  device = rtcNewDevice("threads=1,set_affinity=0");
  if (device == nullptr) throw MeshError("Embree cannot be started");
  rtcSetDeviceMemoryMonitorFunction(device, count_bytes, &taken);
  top = rtcNewScene(device);
  rtcSetSceneFlags(top, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC);
}

void EmbreeScene::World::add_shape(const TriangleMesh& mesh) {
  shapes.push_back(std::make_unique<ShapeScene>());
  ShapeScene& shape = *shapes.back();
  shape.triangles = prepare(mesh);
  shape.ids = mesh.triangle_ids();
  shape.bounds = mesh.bounds();
  shape.center = shape.bounds.center();
  shape.scale = frame.scale;
  largest_of_shapes = std::max(largest_of_shapes, largest_coordinate(mesh.bounds()));
  shape.scene = rtcNewScene(device);
  rtcSetSceneFlags(shape.scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(shape.scene, options.quality == EmbreeDetector::Quality::high
                                           ? RTC_BUILD_QUALITY_HIGH
                                           : RTC_BUILD_QUALITY_MEDIUM);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(mesh.size()));
  rtcSetGeometryUserData(geometry, &shape);
  rtcSetGeometryBoundsFunction(geometry, EmbreeSceneCallbacks::bounds_of, nullptr);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(shape.scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(shape.scene);
  expect_no_error();
}

void EmbreeScene::World::set_transform(std::uint32_t body, RTCGeometry instance) {
  const Pose& pose = bodies[body].pose;
  const ShapeScene& shape = *shapes[bodies[body].shape];
  const Vec3 at = frame.into(image(pose, shape.center));
  std::array<float, 12> columns;
  Eigen::Map<Eigen::Matrix3f>(columns.data()) = pose.rotation.cast<float>();
  Eigen::Map<Eigen::Vector3f>(columns.data() + 9) = at.cast<float>();
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
  rtcCommitGeometry(instance);
}

void EmbreeScene::World::add_instance(std::uint32_t body) {
  RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(instance, shapes[bodies[body].shape]->scene);
  set_transform(body, instance);
  rtcAttachGeometryByID(top, instance, body);
  rtcReleaseGeometry(instance);
}

EmbreeScene::EmbreeScene(const PosedScene& scene, const EmbreeDetector::Options& options)
    : world_(make_hidden<World>(scene, options)) {
  world_->start();
  for (const auto& mesh : scene.shapes) world_->add_shape(*mesh);
  for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) world_->add_instance(i);
  publish();
}

void EmbreeScene::place(std::uint32_t body, const Pose& pose) {
  World& world = *world_;
  world.bodies[body].pose = pose;
  const ShapeScene& shape = *world.shapes[world.bodies[body].shape];
  const Aabb box = image_of_box(pose, shape.bounds);
  world.bounds.extend(box.min);
  world.bounds.extend(box.max);
  world.set_transform(body, rtcGetGeometry(world.top, body));
}

void EmbreeScene::publish() {
  World& world = *world_;
  world.largest =
      world.frame.into(world.bounds.max).cwiseAbs().cwiseMax(world.frame.into(world.bounds.min).cwiseAbs());
  rtcCommitScene(world.top);
  world.expect_no_error();
}

std::optional<BodyContact> EmbreeScene::nearest_body(const Probe& probe, double reach,
                                                     Session& session) const noexcept {
  const World& world = *world_;
  const bool checked = world.options.query == Asking::checked;
  const auto forget = [&] { session.body = session.triangle = no_triangle; };
  if (checked && out_of_reach(world.bounds, probe.center, reach)) {
    forget();
    return std::nullopt;
  }
  if (!answerable(probe.center, reach)) return std::nullopt;
  const double within = finite_reach(world.bounds, probe.center, reach);
  EmbreeSceneCallbacks::Search search(world, probe.center);
  if (world.options.warm && session.body < world.bodies.size())
    search.consider(session.body, session.triangle);
  const Vec3& p = search.in_scene_frame;
  RTCPointQuery query{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 0,
                      search.radius(std::min(within, search.distance()))};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(world.top, &query, &context, EmbreeSceneCallbacks::nearest, &search);
  session.work.triangles += search.tested;
  const bool found = search.body < world.bodies.size() && search.distance() <= within;
  if (!found) {
    if (checked) forget();
    return std::nullopt;
  }
  session.body = search.body;
  session.triangle = search.best.index;
  const ShapeScene& shape = *world.shapes[world.bodies[search.body].shape];
  const Pose& pose = world.bodies[search.body].pose;
  const Contact contact = contact_on(shape.triangles[search.best.index], in_frame(pose, probe.center),
                                     shape.ids[search.best.index]);
  return BodyContact{{search.body, 0}, placed_contact(pose, contact)};
}

std::size_t EmbreeScene::bytes() const noexcept {
  std::size_t sum =
      static_cast<std::size_t>(world_->taken) + world_->bodies.capacity() * sizeof(world_->bodies[0]);
  for (const std::unique_ptr<ShapeScene>& shape : world_->shapes)
    sum += shape->triangles.capacity() * sizeof(PreparedTriangle) + shape->ids.bytes();
  return sum;
}

Accuracy EmbreeScene::accuracy() const noexcept {
  return with_poses({Guarantee::exact, kernel_relative_error, 0}, world_->largest_of_shapes);
}

}  // namespace touchmark::baselines
