#include "baselines/embree/embree_detector.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <embree3/rtcore.h>

#include "baselines/reach.h"
#include "core/geometry/point_triangle.h"
#include "core/mesh_update.h"

namespace touchmark::baselines {
namespace {

constexpr double float_roundoff = std::numeric_limits<float>::epsilon() / 2;
constexpr float float_infinity = std::numeric_limits<float>::infinity();

float rounded_up(double x) noexcept {
  const auto nearest = static_cast<float>(x);
  return nearest < x ? std::nextafter(nearest, float_infinity) : nearest;
}
float rounded_down(double x) noexcept { return -rounded_up(-x); }

/// Embree computes in single precision, so it gets the mesh about the origin and of size 1 to 2: then an
/// offset costs no digits, and no coordinate overflows. The scale is a power of two.
struct Frame {
  Vec3 origin;
  double scale = 1;

  explicit Frame(const Aabb& bounds) : origin(bounds.center()) {
    const double size = bounds.extent().maxCoeff();
    if (size > 0) scale = std::ldexp(1.0, -std::ilogb(size));
  }
  Vec3 into(const Vec3& p) const noexcept { return scale * (p - origin); }
  /// By how much a distance between the point and a triangle of the mesh may come out wrong in single
  /// precision: a rounding each for the point's and the vertices' coordinates, for the difference, the
  /// square, the sum of three and the root, on coordinates of at most 1 + |p|.
  double slack(const Vec3& p) const noexcept { return 32 * float_roundoff * (1 + p.cwiseAbs().maxCoeff()); }
};

}  // namespace

struct EmbreeDetector::Model {
  explicit Model(const TriangleMesh& mesh)
      : connectivity(mesh),
        triangles(prepare(mesh)),
        ids(mesh.ids().begin(), mesh.ids().end()),
        bounds(mesh.bounds()),
        frame(bounds) {}
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;
  ~Model() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  TriangleId id(std::uint32_t index) const noexcept { return ids.empty() ? index : ids[index]; }

  Connectivity connectivity;
  std::vector<PreparedTriangle> triangles;
  std::vector<TriangleId> ids;
  Aabb bounds;
  Frame frame;
  bool warm = true;
  Geometry geometry = Geometry::user;
  std::atomic<std::ptrdiff_t> taken{0};  // bytes
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
};

namespace {

[[noreturn]] void fail(RTCDevice device) {
  throw MeshError("Embree failed with error " + std::to_string(static_cast<int>(rtcGetDeviceError(device))));
}

void set_vertices(float* to, const TriangleMesh& mesh, const Frame& frame) {
  for (const Vec3& v : mesh.vertices()) {
    const Vec3 p = frame.into(v);
    for (int k = 0; k < 3; ++k) *to++ = static_cast<float>(p[k]);
  }
}

RTCGeometry triangle_geometry(RTCDevice device, const TriangleMesh& mesh, const Frame& frame) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices().size()));
  auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.size()));
  if (vertices == nullptr || indices == nullptr) fail(device);
  set_vertices(vertices, mesh, frame);
  for (const TriangleMesh::Corners& corners : mesh.triangles())
    indices = std::copy(corners.begin(), corners.end(), indices);
  return geometry;
}

}  // namespace

/// The callbacks that Embree calls, and what they share with the query.
struct EmbreeCallbacks {
  static void bounds_of(const RTCBoundsFunctionArguments* arguments) {
    const auto& model = *static_cast<const EmbreeDetector::Model*>(arguments->geometryUserPtr);
    Aabb box;
    for (const Vec3& corner : model.triangles[arguments->primID].corner) box.extend(model.frame.into(corner));
    RTCBounds& out = *arguments->bounds_o;
    out.lower_x = rounded_down(box.min.x());
    out.lower_y = rounded_down(box.min.y());
    out.lower_z = rounded_down(box.min.z());
    out.upper_x = rounded_up(box.max.x());
    out.upper_y = rounded_up(box.max.y());
    out.upper_z = rounded_up(box.max.z());
  }

  static bool monitor(void* taken, ssize_t bytes, bool) {
    *static_cast<std::atomic<std::ptrdiff_t>*>(taken) += bytes;
    return true;
  }

  struct Search {
    const EmbreeDetector::Model& model;
    const Vec3& center;
    double slack;  // in the frame
    Candidate best;
    std::uint64_t tested = 0;

    float radius(double distance) const noexcept { return rounded_up(model.frame.scale * distance + slack); }
  };

  static bool nearest(RTCPointQueryFunctionArguments* arguments) {
    auto& search = *static_cast<Search*>(arguments->userPtr);
    const PreparedTriangle& triangle = search.model.triangles[arguments->primID];
    ++search.tested;
    const Candidate candidate{squared_distance(triangle, search.center), triangle.index};
    if (!(candidate < search.best)) return false;
    search.best = candidate;
    const float radius = search.radius(std::sqrt(candidate.squared_distance));
    if (!(radius < arguments->query->radius)) return false;
    arguments->query->radius = radius;
    return true;
  }

  struct Touch {
    Search search;
    double radius;
    bool touching = false;
  };

  static bool touch(RTCPointQueryFunctionArguments* arguments) {
    auto& touch = *static_cast<Touch*>(arguments->userPtr);
    if (touch.touching) return false;
    ++touch.search.tested;
    const PreparedTriangle& triangle = touch.search.model.triangles[arguments->primID];
    touch.touching = std::sqrt(squared_distance(triangle, touch.search.center)) <= touch.radius;
    if (touch.touching) arguments->query->radius = 0;  // nothing more is wanted
    return touch.touching;
  }

  static void ask(const EmbreeDetector::Model& model, const Vec3& p, float radius,
                  RTCPointQueryFunction function, void* user) {
    RTCPointQuery query{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 0,
                        radius};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(model.scene, &query, &context, function, user);
  }
};

EmbreeDetector::EmbreeDetector(std::unique_ptr<Model> model) noexcept : model_(std::move(model)) {}
EmbreeDetector::EmbreeDetector(EmbreeDetector&&) noexcept = default;
EmbreeDetector& EmbreeDetector::operator=(EmbreeDetector&&) noexcept = default;
EmbreeDetector::~EmbreeDetector() = default;

namespace {

void commit(RTCScene scene, RTCDevice device) {
  rtcCommitScene(scene);
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE)
    throw MeshError("Embree failed with error " + std::to_string(static_cast<int>(error)));
}

}  // namespace

EmbreeDetector EmbreeDetector::build(const TriangleMesh& mesh, const Options& options) {
  auto model = std::make_unique<Model>(mesh);
  model->warm = options.warm;
  model->geometry = options.geometry;
  // One thread, as everybody else builds with; and the caller's floating-point modes stay as they are.
  model->device = rtcNewDevice("threads=1,set_affinity=0");
  if (model->device == nullptr) fail(nullptr);
  rtcSetDeviceMemoryMonitorFunction(model->device, EmbreeCallbacks::monitor, &model->taken);
  model->scene = rtcNewScene(model->device);
  const bool refits = options.quality == Quality::refit;
  rtcSetSceneFlags(model->scene,
                   refits ? RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC : RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(
      model->scene, options.quality == Quality::high ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
  RTCGeometry geometry = nullptr;
  if (options.geometry == Geometry::triangle) {
    geometry = triangle_geometry(model->device, mesh, model->frame);
  } else {
    geometry = rtcNewGeometry(model->device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(mesh.size()));
    rtcSetGeometryUserData(geometry, model.get());
    rtcSetGeometryBoundsFunction(geometry, EmbreeCallbacks::bounds_of, nullptr);
  }
  if (refits) rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_REFIT);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(model->scene, geometry);
  rtcReleaseGeometry(geometry);
  commit(model->scene, model->device);
  return EmbreeDetector(std::move(model));
}

void EmbreeDetector::update(const TriangleMesh& mesh) {
  Model& model = *model_;
  model.connectivity.expect(mesh);
  for (PreparedTriangle& triangle : model.triangles)
    if (has_moved(triangle, mesh)) triangle = prepare(mesh, triangle.index);
  model.bounds = mesh.bounds();
  model.frame = Frame(model.bounds);
  RTCGeometry geometry = rtcGetGeometry(model.scene, 0);
  // The other one is asked for its boxes again.
  if (model.geometry == Geometry::triangle) {
    set_vertices(static_cast<float*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0)), mesh,
                 model.frame);
    rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
  }
  rtcCommitGeometry(geometry);
  commit(model.scene, model.device);
}

std::optional<Contact> EmbreeDetector::nearest(const Probe& probe, double reach,
                                               Session& session) const noexcept {
  const Model& model = *model_;
  const Vec3& center = probe.center;
  if (!answerable(center, reach)) return std::nullopt;
  const Vec3 p = model.frame.into(center);
  EmbreeCallbacks::Search search{model, center, model.frame.slack(p), {}};
  double limit = finite_reach(model.bounds, center, reach);
  if (model.warm) {
    ++search.tested;
    search.best = {squared_distance(model.triangles[session.last], center), session.last};
    limit = std::min(limit, std::sqrt(search.best.squared_distance));
  }
  EmbreeCallbacks::ask(model, p, search.radius(limit), EmbreeCallbacks::nearest, &search);
  session.work.triangles += search.tested;
  const bool found = search.best.index < model.triangles.size();
  if (!found || !(std::sqrt(search.best.squared_distance) <= reach)) return std::nullopt;
  session.last = search.best.index;
  return contact_on(model.triangles[search.best.index], center, model.id(search.best.index));
}

bool EmbreeDetector::touches(const Probe& probe, Session& session) const noexcept {
  const Model& model = *model_;
  if (!answerable(probe.center, probe.radius)) return false;
  const Vec3 p = model.frame.into(probe.center);
  EmbreeCallbacks::Touch touch{{model, probe.center, model.frame.slack(p), {}}, probe.radius};
  const double limit = finite_reach(model.bounds, probe.center, probe.radius);
  EmbreeCallbacks::ask(model, p, touch.search.radius(limit), EmbreeCallbacks::touch, &touch);
  session.work.triangles += touch.search.tested;
  return touch.touching;
}

std::size_t EmbreeDetector::bytes() const noexcept {
  return static_cast<std::size_t>(model_->taken) + model_->triangles.capacity() * sizeof(PreparedTriangle) +
         model_->ids.capacity() * sizeof(TriangleId);
}

Accuracy EmbreeDetector::accuracy() const noexcept { return {Guarantee::exact, kernel_relative_error, 0}; }

}  // namespace touchmark::baselines
