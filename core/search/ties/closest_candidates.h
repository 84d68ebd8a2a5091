/// The nearest, as computed, of the triangles that a search looks at, and those that rounding may have put
/// behind it: see certified_nearest.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/geometry/point_triangle.h"
#include "core/probe.h"

namespace touchmark {

class NearestOfTies;

class ClosestCandidates {
 public:
  /// `error` is at least the distance_error of the query, M 2^-45 or more: what is not farther than the
  /// nearest by more than that is to be remembered. 0: nothing is.
  /// `triangles` is where they are kept; both they and the centre must outlive this.
  ClosestCandidates(const PreparedTriangle* triangles, const Vec3& center, double error) noexcept
      : closeness_(0x1p47 * error * error), triangles_(triangles), center_(&center) {}
  ClosestCandidates(const PreparedTriangle*, const Vec3&&, double) = delete;

  /// From now on only the nearest as computed is remembered. Before anything is taken.
  void keep_no_ties() noexcept { closeness_ = 0; }

  bool found() const noexcept { return at_ != nowhere; }
  const Candidate& best() const noexcept { return best_; }
  std::uint32_t at() const noexcept { return at_; }  ///< slot of the best

  /// Triangles may come in any order, and more than once. Is it the nearest now, and was not before?
  bool update(const Candidate& candidate, std::uint32_t at) noexcept {
    const double squared = candidate.squared_distance;
    if (squared > limit_) return false;
    if (squared + closeness_ < best_.squared_distance) {
      tie_count_ = 0;
    } else {
      if (at == at_) return false;
      if (tie_count_ == max_ties) compact();
      if (!(candidate < best_)) {
        ties_[tie_count_++] = {squared, at};
        return false;
      }
      ties_[tie_count_++] = {best_.squared_distance, at_};
    }
    best_ = candidate;
    at_ = at;
    limit_ = squared + closeness_;
    return true;
  }

  /// Takes a triangle that is exactly as far as the best, with the same kernel distance: the first of the two
  /// stays.
  void take_as_far(std::uint32_t index, std::uint32_t at) noexcept {
    if (index >= best_.index) return;
    best_.index = index;
    at_ = at;
  }
  /// Bounds how far apart the squares of two distances are that differ by at most the error.
  double closeness() const noexcept { return closeness_; }

  /// Returns true if the best is surely a nearest one of those taken and, of those that are exactly as near,
  /// the first. `error` is as above.
  bool is_surely_first(double error) const noexcept { return tie_count_ == 0 || beats_ties(error); }
  /// Calls visit(slot) for the best and for each of those taken that are farther by at most `error`, or, as
  /// computed, by a little more. Returns false where there were more than there is room for: then some are
  /// forgotten.
  template <class Visit>
  bool visit_close(const Visit& visit) const noexcept {
    if ((exact_decisions_ & was_full) != 0) return false;
    visit(at_);
    for (std::uint32_t i = 0; i < tie_count_; ++i)
      if (ties_[i].squared_distance <= limit_ && ties_[i].at != at_) visit(ties_[i].at);
    return true;
  }
  /// The exactly nearest of those taken is among these: shows `ties` the best and what rounding may have put
  /// behind it.
  void pass_to(NearestOfTies& ties) const noexcept;
  /// How often whole numbers decided what is remembered.
  std::uint64_t exact_decisions() const noexcept { return exact_decisions_ & ~was_full; }

 private:
  struct Tie {
    double squared_distance;
    std::uint32_t at;
  };
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t was_full = std::uint32_t{1} << 31;
  static constexpr std::uint32_t max_ties = 64;  ///< about a corner there are some more than six triangles

  [[gnu::cold, gnu::noinline]] void compact() noexcept;
  bool beats_ties(double error) const noexcept;

  /// Bounds how far apart squares of distances d are that differ by at most the error E: (d + E)^2 - d^2 = E
  /// (2 d + E), and d <= sqrt(3) M.
  double closeness_;
  double limit_ = std::numeric_limits<double>::infinity();  ///< farther than the best by that
  Candidate best_;
  std::uint32_t at_ = nowhere;
  std::uint32_t tie_count_ = 0;
  std::uint32_t exact_decisions_ = 0;  ///< With `was_full` in it, which so takes no time to clear.
  const PreparedTriangle* triangles_;
  const Vec3* center_;
  std::array<Tie, max_ties> ties_;
};

}  // namespace touchmark
