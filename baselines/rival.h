/// What the sessions and the models of rivals have in common.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "baselines/hidden.h"
#include "baselines/reach.h"
#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/mesh_update.h"
#include "core/triangle_ids.h"
#include "core/triangle_mesh.h"

namespace touchmark::baselines {

/// What one haptic point remembers between ticks.
struct RivalSession {
  Work work;
  std::uint32_t last = no_triangle;  ///< checked: of the last contact; plain: the last that was nearest
};

/// A session that also holds objects of the library. One source file alone knows their class.
template <class State>
struct StatefulSession : RivalSession {
  /// Returns the state, which the first call makes.
  State& ready() {
    if (!state) state = make_hidden<State>();
    return *state;
  }

  Hidden<State> state;
};

/// Keeps triangles as near as the last one within, whatever the library computes of it.
inline constexpr double a_little_more = 1 + 1e-6;

/// What a model keeps beside the library's own structures, and the checks before a query.
template <class Options>
struct RivalModel {
  RivalModel(const TriangleMesh& mesh, const Options& chosen) : options(chosen), bounds(mesh.bounds()) {}
  RivalModel(const RivalModel&) = delete;
  RivalModel& operator=(const RivalModel&) = delete;

  bool checked() const noexcept { return options.query == Asking::checked; }

  /// Returns a finite reach to ask the library with, or nothing where the library is not asked. Forgets the
  /// last triangle where the mesh's box is out of reach. NaN counts as infinite.
  std::optional<double> reach_to_ask(const Vec3& center, double reach, std::uint32_t& last) const noexcept {
    if (checked() && out_of_reach(bounds, center, reach)) {
      last = no_triangle;
      return std::nullopt;
    }
    const double finite = finite_reach(bounds, center, reach);
    return answerable(center, finite) ? std::optional(finite) : std::nullopt;
  }

  /// As nearest_by_growing, up to the last triangle first. Where the library finds nothing there, since it
  /// does not know that triangle or computes more than its distance, up to the reach.
  template <class Ask>
  std::optional<Contact> nearest_from_last(const Vec3& center, double reach, RivalSession& session,
                                           const Ask& ask) const {
    double within = reach;
    if (checked() && session.last < triangles.size()) {
      ++session.work.triangles;
      within = std::min(reach, a_little_more * std::sqrt(squared_distance(triangles[session.last], center)));
    }
    std::optional<Contact> contact = nearest_by_growing(bounds, center, within, ask);
    if (!contact && within < reach) contact = nearest_by_growing(bounds, center, reach, ask);
    if (!contact) session.last = no_triangle;
    return contact;
  }

  /// Prepares the triangles that have moved once more.
  void follow(const TriangleMesh& mesh) {
    for (PreparedTriangle& triangle : triangles)
      if (has_moved(triangle, mesh)) triangle = prepare(mesh, triangle.index);
  }

  /// The memory of triangles and ids.
  std::size_t own_bytes() const noexcept {
    return triangles.capacity() * sizeof(PreparedTriangle) + ids.bytes();
  }

  Options options;
  Aabb bounds;
  TriangleIds ids;
  std::vector<PreparedTriangle> triangles;  ///< those that this project's kernel measures
};

/// Throws MeshError for a mesh of more triangles or vertices than the library, which counts in int, can take.
inline void require_int_counts(const char* library, const TriangleMesh& mesh) {
  constexpr auto most = static_cast<std::size_t>(std::numeric_limits<int>::max());
  if (mesh.size() > most || mesh.vertices().size() > most)
    throw MeshError(library +
                    (" counts in int: " + std::to_string(std::max(mesh.size(), mesh.vertices().size()))) +
                    " triangles or vertices are more than " + std::to_string(most));
}

}  // namespace touchmark::baselines
