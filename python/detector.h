/// Batches of questions to one detector: plain arrays in, plain arrays out, on several threads. Nothing here
/// knows Python.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

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

/// How a batch is run.
struct Effort {
  std::size_t threads = 1;  ///< 0: as many as the machine has processors
  /// Called every tenth of a second or so on the thread that asked; true ends the batch.
  std::function<bool()> is_interrupted;
};

/// A detector, its mesh, and what finds sides, which is made by the first who asks for one.
class BatchDetector {
 public:
  BatchDetector(std::shared_ptr<const TriangleMesh> mesh, const std::string& text);

  // Each returns false where it was interrupted. The points are asked in their order: a thread has a part of
  // them that lie one after the other, and a session.
  bool touches(Points centers, Sizes radii, bool* touching, const Effort& effort) const;
  bool nearest(Points centers, Sizes reaches, ContactArrays contacts, const Effort& effort) const;
  bool first_hit(Points from, Points to, Sizes radii, double* fraction, ContactArrays contacts,
                 const Effort& effort) const;
  bool sides(Points centers, std::int8_t* side, const Effort& effort) const;

  const std::shared_ptr<const TriangleMesh>& mesh() const noexcept { return mesh_; }
  const NamedDetector& detector() const noexcept { return *detector_; }

 private:
  std::shared_ptr<const TriangleMesh> mesh_;
  std::unique_ptr<NamedDetector> detector_;
  mutable std::once_flag sides_made_;
  mutable std::optional<SideFinder> sides_;
};

}  // namespace touchmark::python
