#include "bench/results/validation/visits_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/results/validation/json_schema.h"
#include "bench/support/numbers.h"

namespace touchmark::bench::results::validation {
namespace {

using Json = nlohmann::json;

constexpr std::size_t max_of_a_kind = 300;

/// Checks what the schema cannot say, of a document that follows it.
class VisitsCheck {
 public:
  VisitsCheck(const std::string& path, const LocatedJson& visits, const CsvTable* results, Faults& faults)
      : path_(path), visits_(visits), results_(results), faults_(faults) {}

  void run() {
    const std::string run_id = visits_.value.at("run_id");
    if (results_ != nullptr && !results_->records.empty()) {
      const std::string expected = results_->field(results_->records.front(), "run_id");
      if (run_id != expected) {
        fault("/run_id", run_id, "is not that of results.csv, " + expected);
        return;
      }
    }
    const Json& rows = visits_.value.at("rows");
    for (std::size_t i = 0; i < rows.size(); ++i) check_row(fmt::format("/rows/{}", i), rows[i]);
  }

 private:
  void fault(const std::string& pointer, const std::string& value, const std::string& wrong) {
    faults_.push_back({path_, visits_.line_of(pointer), pointer, value, wrong});
  }

  void check_row(const std::string& pointer, const Json& row) {
    std::optional<std::uint64_t> steps_asked;
    if (results_ != nullptr) {
      const CsvRecord* const record = record_of(row);
      if (record == nullptr) {
        fault(pointer, row.at("detector"), "has no row in results.csv");
        return;
      }
      steps_asked = support::parse_count(results_->field(*record, "steps"));
    }
    const Json& steps = row.at("steps");
    if (steps.empty() != row.contains("why_not"))
      fault(pointer, row.at("detector"), "has steps, or says why not, and never both or neither");
    if (steps_asked && steps.size() > *steps_asked)
      fault(pointer + "/steps", fmt::format("[{} items]", steps.size()),
            "are more than the steps of results.csv");
    std::int64_t before = -1;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const std::string at = fmt::format("{}/steps/{}", pointer, i);
      const auto number = steps[i].at("step").get<std::int64_t>();
      if (number <= before) fault(at + "/step", std::to_string(number), "is not after the one before");
      before = number;
      check_step(at, steps[i]);
    }
  }

  const CsvRecord* record_of(const Json& row) const {
    for (const CsvRecord& record : results_->records)
      if (results_->field(record, "detector") == row.at("detector").get<std::string>() &&
          results_->field(record, "options") == row.at("options").get<std::string>() &&
          results_->field(record, "trajectory") == row.at("trajectory").get<std::string>())
        return &record;
    return nullptr;
  }

  void check_step(const std::string& pointer, const Json& step) {
    for (const char* boxes : {"cells", "groups", "boxes"})
      check_each(pointer, step, boxes, [](const Json& box) -> const char* {
        for (std::size_t axis = 0; axis < 3; ++axis)
          if (!(box[axis] <= box[axis + 3])) return "is a box whose least is above its largest";
        if (box.size() > 6 && box[6] != 0 && box[6] != 1) return "has a mark that is not 0 or 1";
        return box.size() > 7 && !(box[7] >= 1) ? "is a group without triangles" : nullptr;
      });
    check_each(pointer, step, "cylinders", [](const Json& one) -> const char* {
      constexpr double single_precision = 1e-5;
      const double length = std::hypot(one[3].get<double>(), one[4].get<double>(), one[5].get<double>());
      if (!(std::abs(length - 1) <= single_precision)) return "has an axis that is not of length 1";
      if (!(one[6] >= 0 && one[7] >= 0)) return "has a radius or a height below 0";
      return one[8] != 0 && one[8] != 1 ? "has a mark that is not 0 or 1" : nullptr;
    });
    if (!step.contains("left_out")) return;
    for (const auto& [name, count] : step.at("left_out").items())
      if (!step.contains(name) || step.at(name).size() != max_of_a_kind)
        fault(pointer + "/left_out/" + name, count.dump(),
              fmt::format("were left out of a list that does not hold {}", max_of_a_kind));
  }

  /// `wrong` returns what is wrong with an item, or null.
  template <class Wrong>
  void check_each(const std::string& pointer, const Json& step, const char* name, Wrong wrong) {
    if (!step.contains(name)) return;
    for (std::size_t i = 0; i < step.at(name).size(); ++i) {
      const char* const told = wrong(step.at(name)[i]);
      if (told != nullptr) fault(fmt::format("{}/{}/{}", pointer, name, i), step.at(name)[i].dump(), told);
    }
  }

  const std::string& path_;
  const LocatedJson& visits_;
  const CsvTable* results_;
  Faults& faults_;
};

}  // namespace

std::string check_visits(const std::string& path, const LocatedJson& visits, const CsvTable* results,
                         Faults& faults) {
  static const JsonSchema schema(Json::parse(visits_schema));
  const std::size_t before = faults.size();
  schema.check(path, visits, faults);
  if (faults.size() == before) VisitsCheck(path, visits, results, faults).run();
  const Json& document = visits.value;
  const bool has_rows = document.is_object() && document.contains("rows") && document["rows"].is_array();
  return fmt::format("what {} rows looked at", has_rows ? document["rows"].size() : 0);
}

}  // namespace touchmark::bench::results::validation
