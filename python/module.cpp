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

#include "python/detector.h"
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

namespace py = pybind11;
using namespace py::literals;

namespace touchmark::python {
namespace {

// Without py::array::forcecast nothing is converted here: another type is a TypeError.
template <class Number>
using Array = py::array_t<Number, py::array::c_style>;

void expect_rows_of_three(const py::array& array, const char* name) {
  if (array.ndim() == 2 && array.shape(1) == 3) return;
  throw std::invalid_argument(std::string(name) + " must have the shape (n, 3)");
}

Points points(const Array<double>& array, const char* name) {
  expect_rows_of_three(array, name);
  return {array.data(), static_cast<std::size_t>(array.shape(0))};
}

Sizes sizes(const Array<double>& array, std::size_t count, const char* name) {
  if (array.ndim() != 1 || (array.shape(0) != 1 && static_cast<std::size_t>(array.shape(0)) != count))
    throw std::invalid_argument(std::string(name) + " must be one number, or one for each point");
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    if (!(array.data()[i] >= 0)) {
      throw std::invalid_argument(
          std::string(name) + (array.shape(0) == 1 ? "" : "[" + std::to_string(i) + "]") + " is " +
          py::str(py::float_(array.data()[i])).cast<std::string>() + "; it must be 0 or more");
    }
  }
  return {array.data(), array.shape(0) == 1};
}

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

/// True once the user has asked to stop; then Python's error is set.
bool is_interrupted() {
  const py::gil_scoped_acquire acquired;
  return PyErr_CheckSignals() != 0;
}

/// Runs a batch without the interpreter's lock; throws what Python has to say where it was interrupted.
template <class Run>
void run(std::size_t threads, const Run& batch) {
  bool complete;
  {
    const py::gil_scoped_release released;
    complete = batch(Effort{threads, is_interrupted});
  }
  if (!complete) throw py::error_already_set();
}

struct Contacts {
  explicit Contacts(std::size_t count)
      : found(static_cast<py::ssize_t>(count)),
        distance(static_cast<py::ssize_t>(count)),
        point(std::vector<py::ssize_t>{static_cast<py::ssize_t>(count), 3}),
        normal(std::vector<py::ssize_t>{static_cast<py::ssize_t>(count), 3}),
        triangle(static_cast<py::ssize_t>(count)) {}

  ContactArrays arrays() {
    return {found.mutable_data(), distance.mutable_data(), point.mutable_data(), normal.mutable_data(),
            triangle.mutable_data()};
  }

  py::array_t<bool> found;
  py::array_t<double> distance, point, normal;
  py::array_t<std::int64_t> triangle;
};

py::array_t<bool> touches(const BatchDetector& detector, const Array<double>& centers,
                          const Array<double>& radii, std::size_t threads) {
  const Points at = points(centers, "points");
  const Sizes within = sizes(radii, at.count, "radius");
  py::array_t<bool> touching(static_cast<py::ssize_t>(at.count));
  bool* const out = touching.mutable_data();
  run(threads, [&](const Effort& effort) { return detector.touches(at, within, out, effort); });
  return touching;
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
  if (from.count != to.count)
    throw std::invalid_argument("starts has " + std::to_string(from.count) + " points and ends has " +
                                std::to_string(to.count));
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

py::tuple bounds(const TriangleMesh& mesh) {
  const auto as_array = [](const Vec3& corner) { return py::array_t<double>(3, corner.data()); };
  return py::make_tuple(as_array(mesh.bounds().min), as_array(mesh.bounds().max));
}

/// It holds its mesh, whose arrays are given out, too.
void define_mesh(py::module_& module) {
  py::class_<TriangleMesh, std::shared_ptr<TriangleMesh>>(module, "Mesh")
      .def(py::init(&make_mesh), "vertices"_a.noconvert(), "faces"_a.noconvert())
      .def("vertices",
           [](const py::object& self) {
             return view_of<double>(self, self.cast<const TriangleMesh&>().vertices());
           })
      .def("faces",
           [](const py::object& self) {
             return view_of<std::uint32_t>(self, self.cast<const TriangleMesh&>().triangles());
           })
      .def("bounds", &bounds);
}

void define_detector(py::module_& module) {
  py::class_<BatchDetector>(module, "Detector")
      .def(py::init([](std::shared_ptr<TriangleMesh> mesh, const std::string& text) {
             const py::gil_scoped_release released;
             return std::make_unique<BatchDetector>(std::move(mesh), text);
           }),
           "mesh"_a, "text"_a)
      .def("touches", &touches, "points"_a.noconvert(), "radius"_a.noconvert(), "threads"_a)
      .def("nearest", &nearest, "points"_a.noconvert(), "reach"_a.noconvert(), "threads"_a)
      .def("first_hit", &first_hit, "starts"_a.noconvert(), "ends"_a.noconvert(), "radius"_a.noconvert(),
           "threads"_a)
      .def("side", &sides, "points"_a.noconvert(), "threads"_a)
      .def("bytes", [](const BatchDetector& detector) { return detector.detector().bytes(); });
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
    }
  });
  define_mesh(module);
  define_detector(module);
}
