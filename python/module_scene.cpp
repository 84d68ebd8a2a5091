// The scene of the Python module.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "python/arrays.h"
#include "python/pickling.h"
#include "python/scene.h"

#include "core/scene/pose.h"
#include "core/triangle_mesh.h"

using namespace pybind11::literals;

namespace touchmark::python {
namespace {

/// Seven numbers: x, y and z, then the quaternion's w, x, y and z.
Pose pose_from(const Array<double>& numbers) {
  if (numbers.ndim() != 1 || numbers.shape(0) != 7) throw std::invalid_argument("a pose is seven numbers");
  const double* n = numbers.data();
  return pose_of({n[0], n[1], n[2]}, n[3], n[4], n[5], n[6]);
}

using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

void store_rows(const Eigen::Matrix3d& matrix, double* to) { Eigen::Map<RowMajor>{to} = matrix; }

py::tuple pose_of_body(const BatchScene& scene, std::int64_t body) {
  Pose pose;
  {
    const py::gil_scoped_release released;
    pose = scene.pose(body);
  }
  py::array_t<double> position(3, pose.translation.data());
  py::array_t<double> rotation(std::vector<py::ssize_t>{3, 3});
  store_rows(pose.rotation, rotation.mutable_data());
  return py::make_tuple(position, rotation);
}

std::int64_t add(BatchScene& scene, std::size_t shape, const Array<double>& pose) {
  const Pose where = pose_from(pose);
  const py::gil_scoped_release released;
  return scene.add(shape, where);
}

void move(BatchScene& scene, std::int64_t body, const Array<double>& pose) {
  const Pose where = pose_from(pose);
  const py::gil_scoped_release released;
  scene.move(body, where);
}

py::tuple nearest(const BatchScene& scene, const Array<double>& centers, const Array<double>& reaches,
                  std::size_t threads) {
  const Points at = points(centers, "points");
  const Sizes within = sizes(reaches, at.count, "reach");
  Contacts contacts(at.count);
  py::array_t<std::int64_t> body(static_cast<py::ssize_t>(at.count));
  const ContactArrays out = contacts.arrays();
  std::int64_t* const bodies = body.mutable_data();
  run(threads, [&](const Effort& effort) { return scene.nearest(at, within, out, bodies, effort); });
  return py::make_tuple(contacts.found, contacts.distance, contacts.point, contacts.normal, contacts.triangle,
                        body);
}

py::tuple first_hit(const BatchScene& scene, const Array<double>& starts, const Array<double>& ends,
                    const Array<double>& radii, std::size_t threads) {
  const Points from = points(starts, "starts"), to = points(ends, "ends");
  expect_as_many(from, to);
  const Sizes within = sizes(radii, from.count, "radius");
  Contacts contacts(from.count);
  py::array_t<double> fraction(static_cast<py::ssize_t>(from.count));
  py::array_t<std::int64_t> body(static_cast<py::ssize_t>(from.count));
  double* const fractions = fraction.mutable_data();
  std::int64_t* const bodies = body.mutable_data();
  const ContactArrays out = contacts.arrays();
  run(threads, [&](const Effort& effort) {
    return scene.first_hit(from, to, within, fractions, out, bodies, effort);
  });
  return py::make_tuple(contacts.found, fraction, contacts.distance, contacts.point, contacts.normal,
                        contacts.triangle, body);
}

/// Shapes as pairs of a mesh and a radius. Places as arrays: the shape, how many bodies had the place before,
/// and twelve numbers of the pose, the position first.
py::tuple state_of(const BatchScene& scene) {
  const BatchScene::Recipe recipe = [&] {
    const py::gil_scoped_release released;
    return scene.recipe();
  }();
  py::list shapes;
  for (const auto& [mesh, radius] : recipe.shapes) shapes.append(py::make_tuple(for_python(mesh), radius));
  const auto count = static_cast<py::ssize_t>(recipe.places.size());
  py::array_t<std::uint32_t> shape(count), before(count);
  py::array_t<double> poses(std::vector<py::ssize_t>{count, 12});
  for (py::ssize_t i = 0; i < count; ++i) {
    const BatchScene::Place& place = recipe.places[static_cast<std::size_t>(i)];
    shape.mutable_at(i) = place.shape;
    before.mutable_at(i) = place.before;
    Eigen::Map<Vec3>{poses.mutable_data(i, 0)} = place.pose.translation;
    store_rows(place.pose.rotation, poses.mutable_data(i, 3));
  }
  return py::make_tuple(package_version(), shapes, shape, before, poses);
}

std::unique_ptr<BatchScene> scene_from(const py::tuple& state) {
  expect_pickle(state, 5, "Scene");
  BatchScene::Recipe recipe;
  for (const py::handle& parts : state[1]) {
    const auto [mesh, radius] = parts.cast<std::pair<std::shared_ptr<TriangleMesh>, double>>();
    recipe.shapes.push_back({mesh, radius});
  }
  const auto shape = state[2].cast<Array<std::uint32_t>>(), before = state[3].cast<Array<std::uint32_t>>();
  const auto poses = state[4].cast<Array<double>>();
  for (py::ssize_t i = 0; i < shape.shape(0); ++i) {
    const Pose pose{Eigen::Map<const RowMajor>{poses.data(i, 3)}, Eigen::Map<const Vec3>{poses.data(i, 0)}};
    recipe.places.push_back({shape.at(i), before.at(i), pose});
  }
  const py::gil_scoped_release released;
  return std::make_unique<BatchScene>(recipe);
}

}  // namespace

void define_scene(py::module_& module) {
  using Released = py::call_guard<py::gil_scoped_release>;
  py::class_<BatchScene>(module, "Scene")
      .def(py::init<>())
      .def(py::pickle(&state_of, &scene_from))
      .def(
          "add_mesh",
          [](BatchScene& scene, const std::shared_ptr<TriangleMesh>& mesh) { return scene.add_mesh(mesh); },
          "mesh"_a, Released())
      .def("add_plane", &BatchScene::add_plane, "size_x"_a, "size_y"_a, Released())
      .def("add_box", &BatchScene::add_box, "size_x"_a, "size_y"_a, "size_z"_a, Released())
      .def("add_sphere", &BatchScene::add_sphere, "radius"_a, Released())
      .def("add_capsule", &BatchScene::add_capsule, "radius"_a, "length"_a, Released())
      .def("add", &add, "shape"_a, "pose"_a.noconvert())
      .def("move", &move, "body"_a, "pose"_a.noconvert())
      .def("remove", &BatchScene::remove, "body"_a, Released())
      .def("pose", &pose_of_body, "body"_a)
      .def("size", &BatchScene::size, Released())
      .def("bytes", &BatchScene::bytes, Released())
      .def("touches", &touches<BatchScene>, "points"_a.noconvert(), "radius"_a.noconvert(), "threads"_a)
      .def("nearest", &nearest, "points"_a.noconvert(), "reach"_a.noconvert(), "threads"_a)
      .def("first_hit", &first_hit, "starts"_a.noconvert(), "ends"_a.noconvert(), "radius"_a.noconvert(),
           "threads"_a);
}

}  // namespace touchmark::python
