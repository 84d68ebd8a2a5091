/// What pickles of all classes have in common: they begin with the version that made them.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include <pybind11/pybind11.h>

#include "core/triangle_mesh.h"

namespace touchmark::python {

namespace py = pybind11;

inline std::string package_version() {
  return py::module_::import("touchmark").attr("__version__").cast<std::string>();
}

/// Throws ValueError for the pickle of another version, or of another size than this one writes.
inline void expect_pickle(const py::tuple& state, std::size_t size, const char* what) {
  const std::string here = package_version();
  const std::string version = state.empty() ? "" : py::str(state[0]).cast<std::string>();
  if (version != here)
    throw py::value_error(std::string(what) + " was pickled by touchmark " + version +
                          ", and this is touchmark " + here +
                          ": unpickle it with that version, or build it anew from vertices and faces");
  if (state.size() != size) throw py::value_error("the pickle of a " + std::string(what) + " is damaged");
}

/// Python has no constant meshes, and no function of Mesh changes one.
inline std::shared_ptr<TriangleMesh> for_python(const std::shared_ptr<const TriangleMesh>& mesh) {
  return std::const_pointer_cast<TriangleMesh>(mesh);
}

}  // namespace touchmark::python
