/// The triangles within a reach, nearest first: what `contacts` answers, whoever finds the triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "core/aabb.h"
#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/probe.h"
#include "core/search/ties/nearest_of_ties.h"
#include "core/search/ties/same_location.h"
#include "core/triangle_ids.h"

namespace touchmark {

/// Keeps in `into` the first of all contacts shown, of which this is the one after `count` others. They are
/// in no order; where there is no more room, as a heap, the last on top.
template <class IsBefore>
void keep_first(std::span<Contact> into, std::size_t count, const Contact& contact,
                const IsBefore& is_before) noexcept {
  if (count < into.size()) {
    into[count] = contact;
    if (count + 1 == into.size()) std::make_heap(into.begin(), into.end(), is_before);
  } else if (!into.empty() && is_before(contact, into.front())) {
    std::pop_heap(into.begin(), into.end(), is_before);
    into.back() = contact;
    std::push_heap(into.begin(), into.end(), is_before);
  }
}

/// What a search asks about, and where its triangles are; all of it outlives the search.
struct ContactsQuestion {
  std::span<const PreparedTriangle> triangles;
  const Aabb& bounds;  ///< hold the triangles
  const TriangleIds& ids;
  const Vec3& center;           ///< finite
  double reach;                 ///< at least 0
  std::span<Contact> into;      ///< room for the nearest
  bool decides_exactly = true;  ///< false: as doubles have it
  bool counts_all = true;       ///< false: those that are not kept need not be shown
};

/// The squares in 106 bits of the distances to triangles that doubles do not tell apart, each computed once
/// or little more often, in however many comparisons it takes part.
class CloseSquares {
 public:
  SquaredDistance of(std::uint32_t slot, const PreparedTriangle& triangle, const Vec3& center) noexcept;

 private:
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

  bool is_used_ = false;  ///< else the arrays are not set yet
  std::array<std::uint32_t, 64> slot_;
  std::array<SquaredDistance, 64> square_;
};

/// Decides which triangles are within the reach, counts them, and keeps the nearest. A search shows each
/// triangle whose computed distance is at most the reach and the error, once, in any order.
///
/// Every decision is that of the exact distances, where it is asked to decide exactly: doubles settle most
/// (docs/exactness.md, E2 and E9), and nearest_of_ties.h the rest. So each contact is the same bits whoever
/// finds it.
class ContactsWithin {
 public:
  explicit ContactsWithin(const ContactsQuestion& question) noexcept;

  /// Bounds the error of a computed distance; infinite where every triangle is to be shown.
  double error() const noexcept { return is_scaled_ ? infinite : error_; }
  void consider(std::uint32_t slot, Work& work) noexcept {
    consider(slot, offset_from(question_.triangles[slot], question_.center), work);
  }
  /// Likewise, where offset_from(triangle, center) is known.
  void consider(std::uint32_t slot, const Offset& offset, Work& work) noexcept;
  /// Returns the computed distance from which on nothing is kept any more, where not all are counted. Falls
  /// as contacts are shown.
  double farthest() const noexcept {
    if (question_.counts_all || is_scaled_) return infinite;
    return question_.into.empty() ? 0 : farthest_kept_;
  }
  /// Returns how many triangles were shown that are within the reach; the nearest are in their order then.
  /// After `max_decisions` that is the order of the computed distances.
  std::size_t finish(Work& work, std::uint64_t max_decisions = LimitedWork::unlimited) noexcept;
  /// Returns true, once finished, if it made as many exact decisions as it was allowed.
  bool ran_out() const noexcept { return exact_decisions_ >= max_decisions_; }
  struct Nearest {
    std::uint32_t slot;
    double distance;  ///< as computed
  };
  /// Once finished, the nearest of those kept; nothing where none was.
  const std::optional<Nearest>& nearest() const noexcept { return nearest_; }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  /// A triangle within the reach, its distance as computed.
  struct Found {
    Vec3 offset;
    double squared;
    double distance;  ///< in this unit
    std::uint32_t slot;
  };
  /// So many are gathered before the farther ones are dropped, where no more than a few are asked for.
  static constexpr std::size_t gathered_at_once = 32, max_asked_for = 16;

  double distance_to(const PreparedTriangle& triangle, const Offset& offset) const noexcept;
  bool is_within(const PreparedTriangle& triangle, double distance, Work& work) noexcept;
  static Found found_of(const Contact& kept) noexcept;
  static const Found& found_of(const Found& kept) noexcept { return kept; }
  bool is_before(const Found& a, const Found& b) noexcept;
  bool is_before_as_near(const Found& a, const Found& b) noexcept;
  void keep(const Found& found) noexcept;
  void drop_farther() noexcept;
  void keep_gathered() noexcept;
  template <class Kept>
  void sort(std::span<Kept> kept) noexcept;
  Contact finished(const Found& kept) noexcept;

  ContactsQuestion question_;
  double error_ = 0;
  bool is_scaled_ = false;  ///< fourth powers of the differences do not fit: distances are in another unit
  double scale_ = 1;        ///< a power of two
  Vec3 point_;              ///< the centre in that unit
  double reach_;            ///< likewise
  WithinRadius is_within_;
  CloseSquares squares_;
  std::size_t count_ = 0;
  std::size_t gathered_count_ = 0, kept_count_ = 0;  ///< waiting, and in `into`
  double farthest_kept_ = infinite;                  ///< what is farther, as computed, is not kept
  std::array<Found, gathered_at_once> gathered_;
  std::optional<Nearest> nearest_;
  std::uint64_t exact_decisions_ = 0, max_decisions_ = LimitedWork::unlimited;
};

}  // namespace touchmark
