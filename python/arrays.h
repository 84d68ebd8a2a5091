/// Numpy arrays as plain ones, and batches run without the interpreter's lock. What a user sends is checked
/// by python/touchmark; this checks what would crash.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "python/batch.h"
#include "python/detector.h"
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

namespace touchmark::python {

namespace py = pybind11;

// Without py::array::forcecast nothing is converted here: another type is a TypeError.
template <class Number>
using Array = py::array_t<Number, py::array::c_style>;

inline void expect_rows_of_three(const py::array& array, const char* name) {
  if (array.ndim() == 2 && array.shape(1) == 3) return;
  throw std::invalid_argument(std::string(name) + " must have the shape (n, 3)");
}

inline Points points(const Array<double>& array, const char* name) {
  expect_rows_of_three(array, name);
  return {array.data(), static_cast<std::size_t>(array.shape(0))};
}

inline Sizes sizes(const Array<double>& array, std::size_t count, const char* name) {
  if (array.ndim() != 1 || (array.shape(0) != 1 && static_cast<std::size_t>(array.shape(0)) != count))
    throw std::invalid_argument(std::string(name) + " must be one number, or one for each point");
  for (py::ssize_t i = 0; i < array.shape(0); ++i)
    if (!(array.data()[i] >= 0))
      throw std::invalid_argument(
          std::string(name) + (array.shape(0) == 1 ? "" : "[" + std::to_string(i) + "]") + " is " +
          py::str(py::float_(array.data()[i])).cast<std::string>() + "; it must be 0 or more");
  return {array.data(), array.shape(0) == 1};
}

inline void expect_as_many(const Points& starts, const Points& ends) {
  if (starts.count == ends.count) return;
  throw std::invalid_argument("starts has " + std::to_string(starts.count) + " points and ends has " +
                              std::to_string(ends.count));
}

/// True once the user has asked to stop; then Python's error is set.
inline bool is_interrupted() {
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

/// Whether what is asked, a detector or a scene, is within the radius of each centre.
template <class Asked>
py::array_t<bool> touches(const Asked& asked, const Array<double>& centers, const Array<double>& radii,
                          std::size_t threads) {
  const Points at = points(centers, "points");
  const Sizes within = sizes(radii, at.count, "radius");
  py::array_t<bool> touching(static_cast<py::ssize_t>(at.count));
  bool* const out = touching.mutable_data();
  run(threads, [&](const Effort& effort) { return asked.touches(at, within, out, effort); });
  return touching;
}

/// Each adds its classes to the module.
void define_scene(py::module_& module);
void define_proxy(py::module_& module);

}  // namespace touchmark::python
