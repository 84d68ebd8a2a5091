// The native part of the Python module: numpy arrays become plain ones, and the interpreter is let go while a
// batch runs. python/touchmark/__init__.py checks what a user sends; this checks what would crash.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "python/arrays.h"
#include "python/detector.h"
#include "python/fork_safe_lock.h"
#include "python/pickling.h"
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "core/scene/body.h"
#include "core/scene/pose.h"

namespace py = pybind11;
using namespace py::literals;

namespace touchmark::python {
namespace {

std::shared_ptr<TriangleMesh> make_mesh(const Array<double>& vertices, const Array<std::uint32_t>& faces) {
  const Points from = points(vertices, "vertices");
  expect_rows_of_three(faces, "faces");
  if (from.count > std::numeric_limits<std::uint32_t>::max()) throw MeshError("more than 2^32 - 1 vertices");
  std::vector<Vec3> corners(from.count);
  for (std::size_t i = 0; i < from.count; ++i) corners[i] = from.at(i);
  std::vector<TriangleMesh::Corners> triangles(static_cast<std::size_t>(faces.shape(0)));
  for (std::size_t i = 0; i < triangles.size(); ++i)
    std::copy_n(faces.data() + 3 * i, 3, triangles[i].begin());
  const py::gil_scoped_release released;
  return std::make_shared<TriangleMesh>(std::move(corners), std::move(triangles));
}

/// The mesh's own numbers, which cannot be written to; they live as long as the array does.
template <class Number, class Row>
py::array view_of(py::object mesh, std::span<const Row> rows) {
  static_assert(sizeof(Row) == 3 * sizeof(Number));
  py::array_t<Number> view({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}},
                           reinterpret_cast<const Number*>(rows.data()), std::move(mesh));
  view.attr("setflags")("write"_a = false);
  return view;
}

py::tuple nearest(const BatchDetector& detector, const Array<double>& centers, const Array<double>& reaches,
                  std::size_t threads) {
  const Points at = points(centers, "points");
  const Sizes within = sizes(reaches, at.count, "reach");
  Contacts contacts(at.count);
  const ContactArrays out = contacts.arrays();
  run(threads, [&](const Effort& effort) { return detector.nearest(at, within, out, effort); });
  return py::make_tuple(contacts.found, contacts.distance, contacts.point, contacts.normal,
                        contacts.triangle);
}

py::tuple first_hit(const BatchDetector& detector, const Array<double>& starts, const Array<double>& ends,
                    const Array<double>& radii, std::size_t threads) {
  const Points from = points(starts, "starts"), to = points(ends, "ends");
  expect_as_many(from, to);
  const Sizes within = sizes(radii, from.count, "radius");
  Contacts contacts(from.count);
  py::array_t<double> fraction(static_cast<py::ssize_t>(from.count));
  double* const fractions = fraction.mutable_data();
  const ContactArrays out = contacts.arrays();
  run(threads,
      [&](const Effort& effort) { return detector.first_hit(from, to, within, fractions, out, effort); });
  return py::make_tuple(contacts.found, fraction, contacts.distance, contacts.point, contacts.normal,
                        contacts.triangle);
}

py::array_t<std::int8_t> sides(const BatchDetector& detector, const Array<double>& centers,
                               std::size_t threads) {
  const Points at = points(centers, "points");
  py::array_t<std::int8_t> side(static_cast<py::ssize_t>(at.count));
  std::int8_t* const out = side.mutable_data();
  run(threads, [&](const Effort& effort) { return detector.sides(at, out, effort); });
  return side;
}

template <class Number>
py::array_t<Number> array_of(const std::vector<Number>& numbers) {
  return py::array_t<Number>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

py::tuple contacts(const BatchDetector& detector, const Array<double>& centers, const Array<double>& reaches,
                   std::size_t threads) {
  const Points at = points(centers, "points");
  const Sizes within = sizes(reaches, at.count, "reach");
  ContactLists lists;
  run(threads, [&](const Effort& effort) { return detector.contacts(at, within, lists, effort); });
  Contacts found(lists.contacts.size());
  const ContactArrays out = found.arrays();
  for (std::size_t i = 0; i < lists.contacts.size(); ++i) out.store(i, lists.contacts[i]);
  return py::make_tuple(array_of(lists.ends), found.distance, found.point, found.normal, found.triangle);
}

void update(BatchDetector& detector, const Array<double>& vertices) {
  const Points from = points(vertices, "vertices");
  const py::gil_scoped_release released;
  detector.update(from.all());
}

/// The mesh as it is now.
std::shared_ptr<TriangleMesh> mesh_of(const BatchDetector& detector) { return for_python(detector.mesh()); }

py::tuple bounds(const TriangleMesh& mesh) {
  const auto as_array = [](const Vec3& corner) { return py::array_t<double>(3, corner.data()); };
  return py::make_tuple(as_array(mesh.bounds().min), as_array(mesh.bounds().max));
}

py::array vertices_of(const py::object& mesh) {
  return view_of<double>(mesh, mesh.cast<const TriangleMesh&>().vertices());
}

py::array faces_of(const py::object& mesh) {
  return view_of<std::uint32_t>(mesh, mesh.cast<const TriangleMesh&>().triangles());
}

py::tuple state_of_mesh(const py::object& mesh) {
  return py::make_tuple(package_version(), vertices_of(mesh), faces_of(mesh));
}

std::shared_ptr<TriangleMesh> mesh_from(const py::tuple& state) {
  expect_pickle(state, 3, "Mesh");
  return make_mesh(state[1].cast<Array<double>>(), state[2].cast<Array<std::uint32_t>>());
}

py::tuple state_of_detector(const BatchDetector& detector) {
  const auto [mesh, text] = [&] {
    const py::gil_scoped_release released;
    return detector.recipe();
  }();
  return py::make_tuple(package_version(), for_python(mesh), text);
}

std::shared_ptr<BatchDetector> make_detector(const std::shared_ptr<TriangleMesh>& mesh,
                                             const std::string& text) {
  const py::gil_scoped_release released;
  return std::make_shared<BatchDetector>(mesh, text);
}

std::shared_ptr<BatchDetector> detector_from(const py::tuple& state) {
  expect_pickle(state, 3, "detector");
  return make_detector(state[1].cast<std::shared_ptr<TriangleMesh>>(), state[2].cast<std::string>());
}

/// It holds its mesh, whose arrays are given out, too.
void define_mesh(py::module_& module) {
  py::class_<TriangleMesh, std::shared_ptr<TriangleMesh>>(module, "Mesh")
      .def(py::init(&make_mesh), "vertices"_a.noconvert(), "faces"_a.noconvert())
      .def(py::pickle(&state_of_mesh, &mesh_from))
      .def("__deepcopy__", [](py::object self, const py::dict&) { return self; })  // nothing changes it
      .def("vertices", &vertices_of)
      .def("faces", &faces_of)
      .def("bounds", &bounds);
}

void define_detector(py::module_& module) {
  py::class_<BatchDetector, std::shared_ptr<BatchDetector>>(module, "Detector")
      .def(py::init(&make_detector), "mesh"_a, "text"_a)
      .def(py::pickle(&state_of_detector, &detector_from))
      .def("touches", &touches<BatchDetector>, "points"_a.noconvert(), "radius"_a.noconvert(), "threads"_a)
      .def("nearest", &nearest, "points"_a.noconvert(), "reach"_a.noconvert(), "threads"_a)
      .def("first_hit", &first_hit, "starts"_a.noconvert(), "ends"_a.noconvert(), "radius"_a.noconvert(),
           "threads"_a)
      .def("side", &sides, "points"_a.noconvert(), "threads"_a)
      .def("contacts", &contacts, "points"_a.noconvert(), "reach"_a.noconvert(), "threads"_a)
      .def("update", &update, "vertices"_a.noconvert())
      .def("mesh", &mesh_of, py::call_guard<py::gil_scoped_release>())
      .def("bytes", &BatchDetector::bytes, py::call_guard<py::gil_scoped_release>());
}

}  // namespace
}  // namespace touchmark::python

PYBIND11_MODULE(_native, module) {
  using namespace touchmark::python;
  module.doc() = "The native part of touchmark; use the package itself.";
  module.attr("version") = TOUCHMARK_VERSION;
  py::register_exception_translator([](std::exception_ptr pointer) {
    try {
      if (pointer) std::rethrow_exception(pointer);
    } catch (const touchmark::MeshError& error) {
      PyErr_SetString(PyExc_ValueError, error.what());
    } catch (const touchmark::SceneError& error) {
      PyErr_SetString(PyExc_ValueError, error.what());
    } catch (const touchmark::PoseError& error) {
      PyErr_SetString(PyExc_ValueError, error.what());
    }
  });
  ForkSafeLock::follow_forks();
  define_mesh(module);
  define_detector(module);
  define_scene(module);
  define_proxy(module);
}
