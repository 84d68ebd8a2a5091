#include "bench/experiments/audit/audit_row.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "bench/results/validation/row_check.h"
#include "bench/support/names.h"
#include "bench/support/numbers.h"
#include "bench/support/table.h"

namespace touchmark::bench::experiments::audit {
namespace {

constexpr std::array<support::Name<Shape>, 3> shape_names{
    {{Shape::surface, "surface"}, {Shape::solid, "solid"}, {Shape::hull, "convex hull"}}};

using R = AuditRow;
using Row = const R&;
using B = AuditBody;
using E = LargestError;

bool is_status(std::string_view text) {
  return text == "ok" || text == "differs" || text == "unsupported" || text == "timeout" ||
         text.starts_with("refused: ") || text.starts_with("crashed:");
}
bool is_shape(std::string_view text) { return support::value_in<Shape>(shape_names, text).has_value(); }
bool is_coordinate(std::string_view text) {
  const std::optional<double> value = support::parse_number(text);
  return value && std::isfinite(*value);
}
bool is_place(std::string_view text) {
  return text == "near" || text == "cavities" || text == "inside" || text == "beyond";
}

std::string share(std::size_t part, std::size_t of) {
  return of > 0 ? fmt::format("{:.4g}", static_cast<double>(part) / static_cast<double>(of)) : "";
}
std::string made_up_share(Row row) { return share(row.made_up, row.contacts); }
std::string missed_share(Row row) { return share(row.missed, row.true_contacts); }
template <Place place>
std::string asked(Row row) {
  return std::to_string(row.asked[static_cast<std::size_t>(place)]);
}
template <int axis>
std::string at(Row row) {
  return row.error ? fmt::format("{}", row.error->at[axis]) : "";
}
std::string error_mm(Row row) {
  return row.error && row.body.mm_a_unit ? fmt::format("{:.4g}", row.error->distance * *row.body.mm_a_unit)
                                         : "";
}

using enum results::Presence;
using namespace results::kinds;
using results::Kind, results::text, results::rounded;

constexpr Kind status_kind{is_status, "ok, differs, unsupported, timeout, refused: WHY or crashed:HOW"};
constexpr Kind shape_kind{is_shape, "one of surface, solid, convex hull"};
constexpr Kind place_kind{is_place, "one of near, cavities, inside, beyond"};
constexpr Kind coordinate{is_coordinate, "a finite number"};

// The order is the contract.
constexpr auto columns = std::to_array<results::Column<R>>({
    {"schema", [](Row) { return std::string("1"); }, always, one, "version of these columns"},
    {"file", text<&R::file>, always, any_text, "what was audited, as it was named"},
    {"body", text<&R::body, &B::name>, always, any_text,
     "the first body that has this mesh: a link's or a node's name, or the file's"},
    {"bodies", text<&R::body, &B::bodies>, always, positive_count, "how many bodies have it"},
    {"triangles", text<&R::body, &B::triangles>, always, positive_count, "of the mesh"},
    {"diagonal", text<&R::body, &B::diagonal>, always, finite, "of the mesh's box, in mesh units"},
    {"detector", text<&R::detector>, always, any_text, "the engine's name"},
    {"options", text<&R::options>, optional, any_text, "its options that were written out"},
    {"radius", text<&R::lengths, &AuditLengths::radius>, always, finite, "the probe's, in mesh units"},
    {"tolerance", text<&R::lengths, &AuditLengths::tolerance>, always, positive, "in mesh units"},
    {"points", text<&R::points>, always, whole_number, "points that were asked"},
    {"inside", asked<Place::inside>, always, whole_number, "of these, inside a closed mesh"},
    {"cavities", asked<Place::cavities>, always, whole_number,
     "of these, within the convex hull and clear of the mesh"},
    {"near", asked<Place::near>, always, whole_number, "of these, within twice the radius of the surface"},
    {"beyond", asked<Place::beyond>, always, whole_number, "of these, elsewhere"},
    {"contacts", text<&R::contacts>, always, whole_number, "points where the engine touches"},
    {"made_up", text<&R::made_up>, always, whole_number,
     "of these, those where the mesh is farther than radius and tolerance"},
    {"made_up_share", made_up_share, optional, results::kinds::share, "`made_up` / `contacts`"},
    {"true_contacts", text<&R::true_contacts>, always, whole_number, "points within the radius of the mesh"},
    {"missed", text<&R::missed>, always, whole_number,
     "of these, those deeper than the tolerance where the engine does not touch"},
    {"missed_share", missed_share, optional, results::kinds::share, "`missed` / `true_contacts`"},
    {"max_distance_error", text<&R::error, &E::distance>, optional, length,
     "largest difference from the true distance, in mesh units; inf where the engine found nothing, or no "
     "number"},
    {"max_distance_error_mm", error_mm, optional, length, "the same in mm, where the unit is known"},
    {"error_place", [](Row row) { return row.error ? std::string(name_of(row.error->place)) : ""; }, optional,
     place_kind, "where that is"},
    {"error_x", at<0>, optional, coordinate, "the point, in the mesh's coordinates"},
    {"error_y", at<1>, optional, coordinate, "likewise"},
    {"error_z", at<2>, optional, coordinate, "likewise"},
    {"hull_share", rounded<4, &R::hull_share>, optional, results::kinds::share,
     "of the answers in cavities, those that are the convex hull's and not the mesh's"},
    {"shape", text<&R::shape>, optional, shape_kind,
     "what the engine takes the body for, from 95 % of the answers on: its convex hull by `hull_share`, or a "
     "solid, whose inside is all contact"},
    {"status", text<&R::status>, always, status_kind,
     "`differs` beyond the tolerance: a contact made up or missed, or a distance"},
});

std::string percent(const std::string& of) {
  return of.empty() ? "" : fmt::format("{:.3g} %", 100 * std::stod(of));
}
std::string largest(Row row) {
  if (!row.error) return "";
  return row.body.mm_a_unit ? error_mm(row) + " mm" : fmt::format("{:.4g}", row.error->distance);
}

namespace validation = results::validation;

}  // namespace

std::string_view name_of(Shape shape) noexcept { return support::name_in(shape_names, shape); }

std::span<const results::Column<AuditRow>> audit_columns() { return columns; }

std::string audit_csv(const std::vector<AuditRow>& rows) { return results::table_of(columns, rows).csv(); }

std::string audit_table(const std::vector<AuditRow>& rows) {
  support::Table table({"body", "engine", "triangles", "points", "made up", "missed", "largest error",
                        "where", "taken for", "status"});
  for (Row row : rows)
    table.add({row.body.name, row.contestant(), std::to_string(row.body.triangles),
               std::to_string(row.points()), percent(made_up_share(row)), percent(missed_share(row)),
               largest(row), row.error ? std::string(name_of(row.error->place)) : "", text<&R::shape>(row),
               row.status});
  return table.text();
}

std::string audit_findings(const std::vector<AuditRow>& rows) {
  std::string lines;
  for (Row row : rows) {
    if (row.status != "differs") continue;
    lines += fmt::format("\n{}: {} ", row.body.name, row.contestant());
    if (row.shape == Shape::hull)
      lines +=
          fmt::format("treats it as its convex hull: {:.0f} % of its answers in cavities are the hull's; ",
                      100 * *row.hull_share);
    lines += fmt::format("{} contacts made up of {}, {} missed of {}", row.made_up, row.contacts, row.missed,
                         row.true_contacts);
    if (row.error)
      lines += fmt::format("; off by {} at ({:.6g}, {:.6g}, {:.6g})", largest(row), row.error->at.x(),
                           row.error->at.y(), row.error->at.z());
  }
  return lines.empty() ? "" : lines + "\n";
}

void check_audit(const validation::CsvTable& table, validation::Faults& faults) {
  validation::check_rows(
      table, audit_columns(), audit_columns().size(), faults, [](const validation::RowCheck& row) {
        row.check_fields(audit_columns(), false);
        std::uint64_t asked = 0;
        for (const char* column : {"inside", "cavities", "near", "beyond"}) asked += row.count(column);
        row.expect(asked == row.count("points"), "points", fmt::format("is not the {} of all places", asked));
        for (const auto& [part, of] :
             {std::pair{"made_up", "contacts"}, std::pair{"missed", "true_contacts"}})
          row.expect(row.count(part) <= row.count(of), part, fmt::format("is above {}", of));
        row.expect(!row.is_ok() || row.count("made_up") + row.count("missed") == 0, "status",
                   "is ok with contacts made up or missed");
      });
}

}  // namespace touchmark::bench::experiments::audit
