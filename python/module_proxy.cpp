// The proxy of the Python module.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "python/arrays.h"
#include "python/detector.h"
#include "python/fork_safe_lock.h"

#include "core/haptics/coupling.h"
#include "core/haptics/proxy.h"
#include "core/mesh_motion.h"
#include "core/named/named_detector.h"

using namespace pybind11::literals;

namespace touchmark::python {
namespace {

/// A proxy over a detector that may be updated meanwhile. The interpreter's lock makes its calls take turns.
class HapticPoint {
 public:
  HapticPoint(std::shared_ptr<BatchDetector> detector, const Coupling& coupling)
      : detector_(std::move(detector)), coupling_(coupling) {
    touchmark::expect_usable(coupling_);
    const std::shared_lock shared = locked();
    if (!detector_->detector().accuracy().decides_exactly)
      throw std::invalid_argument("the detector does not decide exactly, so the proxy could cross");
    session_ = detector_->detector().begin_session();
    detector_->detector().expect_limited(coupling_.max_work, *session_);
    updates_ = detector_->updates();
    proxy_ =
        std::make_unique<Proxy<NamedDetector>>(detector_->detector(), coupling_, &detector_->locked_mesh());
  }

  void place(const Vec3& position) {
    if (!position.allFinite()) throw std::invalid_argument("position is not finite");
    proxy_->place(position);
    placed_ = true;
  }

  const ProxyState& step(const Vec3& goal) {
    const std::shared_lock shared = locked();
    see_updates();
    return proxy_->step(goal, *session_);
  }

  bool surface_moving(std::vector<Vec3> vertices) {
    const std::shared_lock shared = locked();
    detector_->detector().expect_sees_mesh_motion();
    const std::shared_ptr<const TriangleMesh> after = detector_->moved(std::move(vertices));
    see_updates();
    return proxy_->surface_moving(MeshMotion(detector_->locked_mesh(), *after), *session_);
  }

  Vec3 force_now(const Vec3& goal) const noexcept { return proxy_->force_now(goal); }

 private:
  /// Forgets what it knew of the surface, if that was updated.
  void see_updates() {
    if (!placed_) throw std::invalid_argument("the proxy was never placed: call place");
    if (updates_ == detector_->updates()) return;
    updates_ = detector_->updates();
    proxy_->surface_moved(&detector_->locked_mesh());
  }
  /// A batch that wants the interpreter's lock may hold an update up: it is let go while this waits.
  std::shared_lock<ForkSafeLock> locked() const {
    std::shared_lock shared(detector_->lock(), std::try_to_lock);
    if (!shared.owns_lock()) {
      const py::gil_scoped_release released;
      shared.lock();
    }
    detector_->expect_usable();
    return shared;
  }

  std::shared_ptr<BatchDetector> detector_;
  Coupling coupling_;
  std::unique_ptr<NamedDetector::Session> session_;
  std::uint64_t updates_ = 0;
  std::unique_ptr<Proxy<NamedDetector>> proxy_;
  bool placed_ = false;
};

py::array_t<double> array_of(const Vec3& vector) { return py::array_t<double>(3, vector.data()); }

Vec3 one_point(const Array<double>& array, const char* name) {
  if (array.ndim() != 1 || array.shape(0) != 3)
    throw std::invalid_argument(std::string(name) + " must have the shape (3,)");
  return {array.data()[0], array.data()[1], array.data()[2]};
}

py::tuple step(HapticPoint& point, const Array<double>& goal) {
  const ProxyState& now = point.step(one_point(goal, "goal"));
  py::array_t<double> normals(std::vector<py::ssize_t>{static_cast<py::ssize_t>(now.contacts), 3});
  for (std::size_t i = 0; i < now.contacts; ++i)
    for (int k = 0; k < 3; ++k) normals.mutable_at(static_cast<py::ssize_t>(i), k) = now.normals[i][k];
  return py::make_tuple(array_of(now.position), array_of(now.force), normals, static_cast<int>(now.status),
                        now.unfinished);
}

}  // namespace

void define_proxy(py::module_& module) {
  py::class_<HapticPoint>(module, "Proxy")
      .def(py::init([](std::shared_ptr<BatchDetector> detector, double radius, double stiffness,
                       double static_friction, double dynamic_friction, double damping, double tick_s,
                       std::uint64_t max_work) {
             return std::make_unique<HapticPoint>(
                 std::move(detector), Coupling{radius, stiffness, static_friction, dynamic_friction, damping,
                                               tick_s, 0, max_work});
           }),
           "detector"_a, "radius"_a, "stiffness"_a, "static_friction"_a, "dynamic_friction"_a, "damping"_a,
           "tick_s"_a, "max_work"_a)
      .def(
          "place",
          [](HapticPoint& point, const Array<double>& position) {
            point.place(one_point(position, "position"));
          },
          "position"_a.noconvert())
      .def(
          "surface_moving",
          [](HapticPoint& point, const Array<double>& vertices) {
            return point.surface_moving(points(vertices, "vertices").all());
          },
          "vertices"_a.noconvert())
      .def("step", &step, "goal"_a.noconvert())
      .def(
          "force_now",
          [](const HapticPoint& point, const Array<double>& goal) {
            return array_of(point.force_now(one_point(goal, "goal")));
          },
          "goal"_a.noconvert());
}

}  // namespace touchmark::python
