/// Judges the answers about one body.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench/experiments/audit/audit_row.h"

namespace touchmark::bench::experiments::audit {
namespace {

/// Yes, no, or no point to tell by.
struct Share {
  std::size_t yes = 0, all = 0;

  void add(bool is_so) {
    yes += is_so ? 1 : 0;
    ++all;
  }
  std::optional<double> value() const {
    return all > 0 ? std::optional(static_cast<double>(yes) / static_cast<double>(all)) : std::nullopt;
  }
  bool tells() const {
    constexpr std::size_t fewest = 10;  // a few points in a notch tell nothing of a body
    return all >= fewest && *value() >= telling_share;
  }
};

/// Returns true if the answer is another than the mesh's, and the one of its hull: solid, or a surface.
bool is_of_hull(const AuditPoint& point, const AuditAnswer& answer, const AuditLengths& lengths) {
  const auto off_by = [&](double distance) { return std::abs(*answer.distance - distance); };
  if (answer.distance && off_by(point.truth.high) <= lengths.tolerance) return answer.touches.value_or(false);
  if (answer.contact(lengths)) return true;
  return answer.distance && off_by(point.hull_depth) <= 2 * lengths.tolerance;
}

void find_shape(AuditRow& row, std::span<const AuditPoint> points, std::span<const AuditAnswer> answers) {
  const AuditLengths& lengths = row.lengths;
  Share solid, hull, beyond;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const bool contact = answers[i].contact(lengths);
    if (points[i].place == Place::inside && points[i].clear(lengths)) solid.add(contact);
    if (points[i].place == Place::cavities) hull.add(is_of_hull(points[i], answers[i], lengths));
    // Who also touches where neither the hull nor the mesh is takes it for something larger.
    if (points[i].hull_depth < -(lengths.radius + lengths.tolerance)) beyond.add(!contact);
  }
  row.hull_share = hull.value();
  if (hull.tells() && beyond.tells())
    row.shape = Shape::hull;
  else
    row.shape = solid.tells() ? Shape::solid : Shape::surface;
}

bool is_within_a_solid(const AuditPoint& point, const AuditRow& row) {
  return point.place == Place::inside && row.shape != Shape::surface;
}

}  // namespace

std::size_t AuditRow::points() const { return std::accumulate(asked.begin(), asked.end(), std::size_t{0}); }

std::string_view fault_of(const AuditPoint& point, const AuditAnswer& answer, const AuditRow& row) {
  const bool contact = answer.contact(row.lengths), within = is_within_a_solid(point, row);
  if (contact && !within && point.clear(row.lengths)) return "made up";
  if (!contact && (within || point.deep(row.lengths))) return "missed";
  return "";
}

void judge(AuditRow& row, std::span<const AuditPoint> points, std::span<const AuditAnswer> answers) {
  if (answers.empty()) return;
  find_shape(row, points, answers);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const AuditPoint& point = points[i];
    const bool within = is_within_a_solid(point, row);
    const std::string_view fault = fault_of(point, answers[i], row);
    ++row.asked[static_cast<std::size_t>(point.place)];
    row.contacts += answers[i].contact(row.lengths) ? 1 : 0;
    row.true_contacts += within || point.truth.high <= row.lengths.radius ? 1 : 0;
    row.made_up += fault == "made up" ? 1 : 0;
    row.missed += fault == "missed" ? 1 : 0;
    if (within || !answers[i].distance) continue;
    const double error = std::abs(*answers[i].distance - point.truth.high);
    if (!row.error || !(error <= row.error->distance)) row.error = {error, point.center, point.place};
  }
  const bool off = row.error && !(row.error->distance <= row.lengths.tolerance);
  if (row.status == "ok" && (off || row.made_up + row.missed > 0)) row.status = "differs";
}

}  // namespace touchmark::bench::experiments::audit
