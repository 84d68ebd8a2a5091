/// Batches of questions to one detector: plain arrays in, plain arrays out, on several threads. Nothing here
/// knows Python.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "python/batch.h"
#include "python/fork_safe_lock.h"

#include "core/named/named_detector.h"
#include "core/probe.h"
#include "core/sign/side_finder.h"
#include "core/triangle_mesh.h"

namespace touchmark::python {

/// Points as (n, 3) doubles, one after the other.
struct Points {
  const double* coordinates;
  std::size_t count;

  Vec3 at(std::size_t i) const noexcept {
    return {coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]};
  }
  std::vector<Vec3> all() const {
    std::vector<Vec3> points(count);
    for (std::size_t i = 0; i < count; ++i) points[i] = at(i);
    return points;
  }
};

/// One number for all points, or one for each.
struct Sizes {
  const double* values;
  bool one_for_all;

  double at(std::size_t i) const noexcept { return values[one_for_all ? 0 : i]; }
};

/// Arrays that take contacts, one a member; a point without a contact gets false, infinity, not-a-number and
/// -1.
struct ContactArrays {
  bool* found;
  double* distance;
  double* point;
  double* normal;
  std::int64_t* triangle;

  void store(std::size_t i, const std::optional<Contact>& contact) const noexcept;
};

/// The contacts of some points, those of one point after those of the one before.
struct ContactLists {
  std::vector<std::int64_t> ends;  ///< those of point i end before ends[i]
  std::vector<Contact> contacts;
};

/// A detector, its mesh, and what finds sides, which is made by the first who asks for one.
class BatchDetector {
 public:
  BatchDetector(std::shared_ptr<const TriangleMesh> mesh, std::string text);

  // Each returns false where it was interrupted. The points are asked in their order: a thread has a part of
  // them that lie one after the other, and a session.
  bool touches(Points centers, Sizes radii, bool* touching, const Effort& effort) const;
  bool nearest(Points centers, Sizes reaches, ContactArrays contacts, const Effort& effort) const;
  bool first_hit(Points from, Points to, Sizes radii, double* fraction, ContactArrays contacts,
                 const Effort& effort) const;
  bool sides(Points centers, std::int8_t* side, const Effort& effort) const;
  bool contacts(Points centers, Sizes reaches, ContactLists& lists, const Effort& effort) const;

  /// Takes other places for the mesh's vertices, as many as it has. It waits for the batches that run, and
  /// they for it. Throws MeshError or std::invalid_argument and is as it was; after anything else that is
  /// thrown it answers no more.
  void update(std::vector<Vec3> vertices);
  std::shared_ptr<const TriangleMesh> mesh() const;
  /// Returns what the constructor is to be given for a detector of the mesh as it is now. Throws
  /// std::invalid_argument where this one answers no more.
  std::pair<std::shared_ptr<const TriangleMesh>, std::string> recipe() const;
  std::size_t bytes() const;

  // What follows is for who holds `lock()`, shared: updates wait meanwhile.

  /// Throws std::invalid_argument where it answers no more.
  void expect_usable() const;
  ForkSafeLock& lock() const noexcept { return lock_; }
  const NamedDetector& detector() const noexcept { return *detector_; }
  const TriangleMesh& locked_mesh() const noexcept { return *mesh_; }
  /// Returns the mesh with its vertices elsewhere. Throws MeshError or std::invalid_argument.
  std::shared_ptr<const TriangleMesh> moved(std::vector<Vec3> vertices) const;
  std::uint64_t updates() const noexcept { return updates_; }

 private:
  const SideFinder& side_finder() const;
  /// Runs a batch of `count` questions while no update runs.
  template <class Ask>
  bool ask_all(std::size_t count, const Effort& effort, const Ask& ask) const;

  const std::string text_;
  std::shared_ptr<const TriangleMesh> mesh_;
  std::unique_ptr<NamedDetector> detector_;
  std::uint64_t updates_ = 0;
  bool usable_ = true;
  mutable ForkSafeLock lock_;  ///< of all that is above: updates take it alone
  mutable ForkSafeLock making_sides_;
  mutable std::optional<SideFinder> sides_;
};

}  // namespace touchmark::python
