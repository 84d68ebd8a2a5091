// The scene of the Python module.
#include <cstddef>
#include <cstdint>
#include <memory>

#include "python/arrays.h"
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

py::tuple pose_of_body(const BatchScene& scene, std::int64_t body) {
  Pose pose;
  {
    const py::gil_scoped_release released;
    pose = scene.pose(body);
  }
  py::array_t<double> position(3, pose.translation.data());
  py::array_t<double> rotation(std::vector<py::ssize_t>{3, 3});
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) rotation.mutable_at(row, column) = pose.rotation(row, column);
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

}  // namespace

void define_scene(py::module_& module) {
  using Released = py::call_guard<py::gil_scoped_release>;
  py::class_<BatchScene>(module, "Scene")
      .def(py::init<>())
      .def("add_mesh", &BatchScene::add_mesh, "mesh"_a, Released())
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
