/// What an engine's answers about one body are like: a row of audit.csv and of the printed table.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/experiments/audit/audit_points.h"
#include "bench/results/column.h"
#include "bench/results/validation/fault.h"
#include "bench/results/validation/results_check.h"

namespace touchmark::bench::experiments::audit {

/// One mesh, which several bodies of a scene may share.
struct AuditBody {
  std::string name;        ///< the first one's
  std::size_t bodies = 1;  ///< how many have the mesh
  std::size_t triangles = 0;
  double diagonal = 0;                   ///< mesh units
  std::optional<double> mm_a_unit = {};  ///< nothing: the unit is unknown
};

/// What an engine said of a point; nothing where it does not answer such queries.
struct AuditAnswer {
  std::optional<bool> touches = {};
  std::optional<double> distance = {};  ///< infinite where it found nothing, though the mesh is in reach

  bool contact(const AuditLengths& lengths) const {
    return touches ? *touches : distance && *distance <= lengths.radius;
  }
};

/// What an engine takes a body for: its triangles; the solid within them; their convex hull.
enum class Shape : std::uint8_t { surface, solid, hull };
std::string_view name_of(Shape shape) noexcept;

/// The shape has the name convex hull, and solid, from such a share of the answers on.
inline constexpr double telling_share = 0.95;

struct LargestError {
  double distance = 0;  ///< mesh units
  Vec3 at = Vec3::Zero();
  Place place = Place::near;
};

struct AuditRow {
  std::string file;
  AuditBody body;
  std::string detector, options;
  AuditLengths lengths;
  std::array<std::size_t, places> asked{};  ///< points in each place
  std::size_t contacts = 0, made_up = 0;    ///< the engine's, and those of them where the mesh is clear
  std::size_t true_contacts = 0, missed = 0;
  std::optional<double> hull_share = {};  ///< the answers in cavities that are the hull's
  std::optional<Shape> shape = {};        ///< nothing where no point was asked
  std::optional<LargestError> error = {};
  std::string status = "ok";  ///< else differs, unsupported, refused: WHY, timeout, crashed:HOW

  std::string contestant() const { return options.empty() ? detector : detector + ":" + options; }
  std::size_t points() const;
  /// True if it refused the body, or answers neither touches nor nearest.
  bool declined() const { return status == "unsupported" || status.starts_with("refused: "); }
};

/// Fills in what the answers to the first points tell, and the status unless it has one. What is inside a
/// closed body is contact to an engine that takes it for a solid, or for the hull.
void judge(AuditRow& row, std::span<const AuditPoint> points, std::span<const AuditAnswer> answers);

/// "made up", "missed" or nothing: what is wrong with a contact.
std::string_view fault_of(const AuditPoint& point, const AuditAnswer& answer, const AuditRow& row);

/// The columns of audit.csv, schema 1. Columns are only ever appended.
std::span<const results::Column<AuditRow>> audit_columns();

std::string audit_csv(const std::vector<AuditRow>& rows);
std::string audit_table(const std::vector<AuditRow>& rows);
/// A line for each row that differs.
std::string audit_findings(const std::vector<AuditRow>& rows);

/// Checks that a file is an audit.csv of schema 1, and agrees with itself.
void check_audit(const results::validation::CsvTable& table, results::validation::Faults& faults);

}  // namespace touchmark::bench::experiments::audit
