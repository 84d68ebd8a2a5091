#include "baselines/embree/embree_detector.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#if TOUCHMARK_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "baselines/embree/closest_point.h"
#include "baselines/embree/frame.h"
#include "baselines/embree/rounding.h"
#include "core/geometry/point_triangle.h"
#include "core/mesh_update.h"

namespace touchmark::baselines {

struct EmbreeDetector::Model : RivalModel<EmbreeDetector::Options> {
  Model(const TriangleMesh& mesh, const Options& chosen)
      : RivalModel(mesh, chosen), connectivity(mesh), frame(bounds), size(mesh.size()) {
    ids = mesh.triangle_ids();
    if (options.geometry != Geometry::triangle) triangles = prepare(mesh);
  }
  ~Model() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  /// Embree's own copy; of triangle geometry only.
  std::array<Eigen::Vector3f, 3> corners(std::uint32_t index) const noexcept {
    const std::uint32_t* corner = indices + 3 * std::size_t{index};
    const auto at = [&](std::uint32_t i) {
      return Eigen::Vector3f(Eigen::Map<const Eigen::Vector3f>(vertices + 3 * std::size_t{i}));
    };
    return {at(corner[0]), at(corner[1]), at(corner[2])};
  }

  Connectivity connectivity;
  EmbreeFrame frame;
  std::size_t size;
  float* vertices = nullptr;  ///< Embree's
  const std::uint32_t* indices = nullptr;
  std::atomic<std::ptrdiff_t> taken{0};  // bytes
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
};

namespace {

[[noreturn]] void fail(RTCDevice device) {
  throw MeshError("Embree failed with error " + std::to_string(static_cast<int>(rtcGetDeviceError(device))));
}

void set_vertices(float* to, const TriangleMesh& mesh, const EmbreeFrame& frame) {
  for (const Vec3& v : mesh.vertices()) {
    const Vec3 p = frame.into(v);
    for (int k = 0; k < 3; ++k) *to++ = static_cast<float>(p[k]);
  }
}

template <class Model>
RTCGeometry triangle_geometry(Model& model, const TriangleMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(model.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  model.vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices().size()));
  auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), mesh.size()));
  if (model.vertices == nullptr || indices == nullptr) fail(model.device);
  model.indices = indices;
  set_vertices(model.vertices, mesh, model.frame);
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
    set_bounds(*arguments->bounds_o, box);
  }

  /// This project's kernel, in the mesh's unit.
  struct Exact {
    Exact(const EmbreeDetector::Model& asked, const Vec3& point)
        : model(asked), center(point), in_frame(asked.frame.into(point)), scale(asked.frame.scale) {}
    double squared(std::uint32_t i) const noexcept { return squared_distance(model.triangles[i], center); }
    double own(double length) const noexcept { return length; }
    Contact contact(const Candidate& best) const noexcept {
      return contact_on(model.triangles[best.index], center, model.ids[best.index]);
    }

    const EmbreeDetector::Model& model;
    const Vec3& center;
    Vec3 in_frame;
    double scale;  ///< what a length measured here is in the frame
  };

  /// Embree's own triangles, in single precision and the frame's unit.
  struct Single {
    Single(const EmbreeDetector::Model& asked, const Vec3& point)
        : model(asked), center(point), in_frame(asked.frame.into(point)), single(in_frame.cast<float>()) {}
    Eigen::Vector3f away(std::uint32_t i) const noexcept {
      return single - closest_point(model.corners(i), single);
    }
    /// Infinite for a triangle that floats make nothing of.
    double squared(std::uint32_t i) const noexcept {
      const float squared = away(i).squaredNorm();
      return squared >= 0 ? squared : std::numeric_limits<double>::infinity();
    }
    double own(double length) const noexcept { return model.frame.scale * length; }
    Contact contact(const Candidate& best) const noexcept {
      const Vec3 from_mesh = away(best.index).cast<double>();
      const auto [a, b, c] = model.corners(best.index);
      const Eigen::Vector3f face = (b - a).cross(c - a).stableNormalized();
      const Vec3 normal =
          best.squared_distance > 0 ? from_mesh.stableNormalized() : Vec3(face.cast<double>());
      return {center - from_mesh / model.frame.scale, normal,
              std::sqrt(best.squared_distance) / model.frame.scale, model.ids[best.index]};
    }

    const EmbreeDetector::Model& model;
    const Vec3& center;
    Vec3 in_frame;
    Eigen::Vector3f single;
    static constexpr double scale = 1;
  };

  template <class Measure>
  struct Search {
    explicit Search(const EmbreeDetector::Model& model, const Vec3& center)
        : measure(model, center), slack(EmbreeFrame::slack(measure.in_frame)) {}
    float radius(double distance) const noexcept { return rounded_up(measure.scale * distance + slack); }
    /// True if the triangle is the nearest so far, or as near and of a lower index.
    bool consider(std::uint32_t triangle) noexcept {
      ++tested;
      const Candidate candidate{measure.squared(triangle), triangle};
      if (!(candidate < best)) return false;
      best = candidate;
      return true;
    }
    double distance() const noexcept { return std::sqrt(best.squared_distance); }

    Measure measure;
    double slack;          ///< in the frame
    double touching = -1;  ///< within this much any triangle ends the search
    Candidate best;
    std::uint64_t tested = 0;
  };

  template <class Measure>
  static bool nearest(RTCPointQueryFunctionArguments* arguments) {
    auto& search = *static_cast<Search<Measure>*>(arguments->userPtr);
    if (!search.consider(arguments->primID)) return false;
    const float radius = search.radius(search.distance());
    if (!(radius < arguments->query->radius)) return false;
    arguments->query->radius = radius;
    return true;
  }

  template <class Measure>
  static bool touch(RTCPointQueryFunctionArguments* arguments) {
    auto& search = *static_cast<Search<Measure>*>(arguments->userPtr);
    if (search.distance() <= search.touching) return false;
    if (!search.consider(arguments->primID) || !(search.distance() <= search.touching)) return false;
    arguments->query->radius = 0;  // nothing more is wanted
    return true;
  }

  template <class Measure>
  static void ask(Search<Measure>& search, double reach, RTCPointQueryFunction function) {
    const Vec3& p = search.measure.in_frame;
    RTCPointQuery query{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 0,
                        search.radius(reach)};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(search.measure.model.scene, &query, &context, function, &search);
  }

  /// Reaches are in the mesh's unit and finite.
  template <class Measure>
  static std::optional<Contact> nearest_within(const EmbreeDetector::Model& model, const Vec3& center,
                                               double reach, EmbreeDetector::Session& session) {
    Search<Measure> search(model, center);
    const double within = search.measure.own(reach);
    const bool first = model.checked() ? session.last < model.size : model.options.warm;
    if (first && model.options.warm) search.consider(session.last < model.size ? session.last : 0);
    ask(search, std::min(within, search.distance()), nearest<Measure>);
    session.work.triangles += search.tested;
    const bool found = search.best.index < model.size && search.distance() <= within;
    if (found || model.checked()) session.last = found ? search.best.index : no_triangle;
    if (!found) return std::nullopt;
    return search.measure.contact(search.best);
  }

  template <class Measure>
  static bool touches(const EmbreeDetector::Model& model, const Probe& probe, double reach,
                      EmbreeDetector::Session& session) {
    Search<Measure> search(model, probe.center);
    search.touching = search.measure.own(probe.radius);
    if (model.checked() && session.last < model.size) search.consider(session.last);
    if (!(search.distance() <= search.touching)) ask(search, search.measure.own(reach), touch<Measure>);
    session.work.triangles += search.tested;
    const bool touching = search.distance() <= search.touching;
    if (model.checked()) session.last = touching ? search.best.index : no_triangle;
    return touching;
  }
};

namespace {

void commit(RTCScene scene, RTCDevice device) {
  rtcCommitScene(scene);
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE)
    throw MeshError("Embree failed with error " + std::to_string(static_cast<int>(error)));
}

}  // namespace

EmbreeDetector EmbreeDetector::build(const TriangleMesh& mesh, const Options& options) {
  auto model = make_hidden<Model>(mesh, options);
  // One thread, as everybody else builds with; and the caller's floating-point modes stay as they are.
  model->device = rtcNewDevice("threads=1,set_affinity=0");
  if (model->device == nullptr) fail(nullptr);
  rtcSetDeviceMemoryMonitorFunction(model->device, count_bytes, &model->taken);
  model->scene = rtcNewScene(model->device);
  const bool refits = options.quality == Quality::refit;
  rtcSetSceneFlags(model->scene,
                   refits ? RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC : RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(
      model->scene, options.quality == Quality::high ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
  RTCGeometry geometry = nullptr;
  if (options.geometry != Geometry::user) {
    geometry = triangle_geometry(*model, mesh);
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
  model.follow(mesh);
  model.bounds = mesh.bounds();
  model.frame = EmbreeFrame(model.bounds);
  RTCGeometry geometry = rtcGetGeometry(model.scene, 0);
  // The other one is asked for its boxes again.
  if (model.options.geometry != Geometry::user) {
    set_vertices(model.vertices, mesh, model.frame);
    rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
  }
  rtcCommitGeometry(geometry);
  commit(model.scene, model.device);
}

std::optional<Contact> EmbreeDetector::nearest(const Probe& probe, double reach,
                                               Session& session) const noexcept {
  const Model& model = *model_;
  const Vec3& center = probe.center;
  const std::optional<double> finite = model.reach_to_ask(center, reach, session.last);
  if (!finite || std::isnan(reach)) return std::nullopt;
  return model.options.geometry == Geometry::triangle
             ? EmbreeCallbacks::nearest_within<EmbreeCallbacks::Single>(model, center, *finite, session)
             : EmbreeCallbacks::nearest_within<EmbreeCallbacks::Exact>(model, center, *finite, session);
}

bool EmbreeDetector::touches(const Probe& probe, Session& session) const noexcept {
  const Model& model = *model_;
  const std::optional<double> finite = model.reach_to_ask(probe.center, probe.radius, session.last);
  if (!finite || std::isnan(probe.radius)) return false;
  return model.options.geometry == Geometry::triangle
             ? EmbreeCallbacks::touches<EmbreeCallbacks::Single>(model, probe, *finite, session)
             : EmbreeCallbacks::touches<EmbreeCallbacks::Exact>(model, probe, *finite, session);
}

std::size_t EmbreeDetector::bytes() const noexcept {
  return static_cast<std::size_t>(model_->taken) + model_->own_bytes();
}

Accuracy EmbreeDetector::accuracy() const noexcept {
  if (model_->options.geometry != Geometry::triangle) return {Guarantee::exact, kernel_relative_error, 0};
  // What its arithmetic would give if it did what it is meant to: a few dozen roundings of differences, one
  // of each coordinate of the mesh and of the point.
  constexpr double roundoff = std::numeric_limits<float>::epsilon() / 2;
  return {Guarantee::approximate, 64 * roundoff, 2 * roundoff * model_->bounds.extent().maxCoeff()};
}

}  // namespace touchmark::baselines
