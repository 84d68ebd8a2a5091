#include "bench/results/validation/steps_check.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/results/steps_file.h"
#include "bench/support/files/packed_blocks.h"
#include "bench/support/files/text_file.h"
#include "bench/support/numbers.h"

namespace touchmark::bench::results::validation {
namespace {

using Json = nlohmann::json;

/// What makes a file no steps.bin at all: where, and what is wrong.
struct Damage {
  std::string where, wrong;
};

std::uint32_t number_at(std::string_view file, std::size_t offset) {
  std::uint32_t number = 0;
  for (std::size_t byte = 0; byte < 4; ++byte)
    number |= static_cast<std::uint32_t>(static_cast<unsigned char>(file[offset + byte])) << (8 * byte);
  return number;
}

class StepsCheck {
 public:
  StepsCheck(std::string path, std::string file, const CsvTable* results, Faults& faults)
      : path_(std::move(path)), file_(std::move(file)), results_(results), faults_(faults) {}

  std::size_t run() {
    read_header();
    run_id_ = text(header_, "run_id");
    const Json& traces = list(header_, "traces");
    check_mesh(object(header_, "mesh"));
    for (const Json& trace : traces) check_trace(trace);
    check_all_rows_are_there();
    return traces.size();
  }

 private:
  void read_header() {
    const std::size_t fixed = steps_magic.size() + 8;
    if (file_.size() < fixed || !file_.starts_with(steps_magic)) throw Damage{"", "is not a steps.bin"};
    const std::uint32_t version = number_at(file_, steps_magic.size());
    if (version != steps_version)
      throw Damage{"version", fmt::format("is {}; this program knows version {}", version, steps_version)};
    const std::size_t size = number_at(file_, steps_magic.size() + 4);
    if (size > file_.size() - fixed) throw Damage{"header", "ends before its length"};
    header_ = Json::parse(file_.begin() + static_cast<std::ptrdiff_t>(fixed),
                          file_.begin() + static_cast<std::ptrdiff_t>(fixed + size), nullptr, false);
    if (!header_.is_object()) throw Damage{"header", "is not a JSON object"};
    blocks_ = std::string_view(file_).substr(fixed + size);
  }

  // Each throws Damage for what is not there or of another type.
  using Name = const char*;
  static const Json& member(const Json& json, Name name, bool (Json::*is)() const noexcept = nullptr,
                            const char* kind = "") {
    if (!json.is_object() || !json.contains(name)) throw Damage{name, "is missing"};
    if (is != nullptr && !(json[name].*is)()) throw Damage{name, fmt::format("is not {}", kind)};
    return json[name];
  }
  static const Json& object(const Json& json, Name name) {
    return member(json, name, &Json::is_object, "an object");
  }
  static const Json& list(const Json& json, Name name) {
    return member(json, name, &Json::is_array, "a list");
  }
  static std::string text(const Json& json, Name name) {
    return member(json, name, &Json::is_string, "a text");
  }
  static std::size_t count(const Json& json, Name name) {
    return member(json, name, &Json::is_number_unsigned, "a count");
  }
  static double number(const Json& json, Name name) {
    return member(json, name, &Json::is_number, "a number");
  }

  /// Returns the items of a block, whose type is to be this. Eight-byte items are looked at as bytes alone.
  std::vector<std::uint32_t> block(const Json& parent, const char* name, const char* type) {
    const Json& json = object(parent, name);
    return block_of(json, name, type);
  }
  std::vector<std::uint32_t> block_of(const Json& json, const char* name, const char* type) {
    if (text(json, "type") != type) throw Damage{name, fmt::format("is not of type {}", type)};
    const std::string_view digits = std::string_view(type).substr(1);
    const std::size_t bits = digits == "8" ? 8 : digits == "16" ? 16 : digits == "32" ? 32 : 64;
    const Json& delta = member(json, "delta");
    const support::PackedBlock block{count(json, "offset"), count(json, "bytes"),
                                     count(json, "items"),  bits / 8,
                                     type[0] == 'f',        delta.is_boolean() && delta.get<bool>()};
    const std::optional<std::string> planes = support::unpacked(blocks_, block);
    if (!planes) throw Damage{name, "is a damaged block"};
    if (bits == 64) return std::vector<std::uint32_t>(block.items);
    return support::integers_of(*planes, block);
  }
  std::size_t axes(const Json& parent, const char* name) {
    const Json& three = list(parent, name);
    if (three.size() != 3) throw Damage{name, "has not three axes"};
    const std::size_t items = block_of(three[0], name, "u16").size();
    for (const Json& axis : three) expect_items(name, block_of(axis, name, "u16").size(), items);
    return items;
  }
  static void expect_items(const char* name, std::size_t found, std::size_t expected) {
    if (found != expected) throw Damage{name, fmt::format("has {} items in place of {}", found, expected)};
  }
  static void expect_below(const char* name, const std::vector<std::uint32_t>& items, std::size_t limit) {
    for (const std::uint32_t item : items)
      if (item >= limit) throw Damage{name, fmt::format("names {} of {}", item, limit)};
  }

  void check_mesh(const Json& mesh) {
    const Json& drawn = object(mesh, "drawn");
    expect_below("corners", block(drawn, "corners", "u32"), axes(drawn, "vertices"));
    const Json& near = object(mesh, "near");
    near_ = block(near, "ids", "u32").size();
    const std::vector<std::uint32_t> corners = block(near, "corners", "u32");
    expect_items("corners", corners.size(), 3 * near_);
    expect_below("corners", corners, block(near, "vertices", "f64").size() / 3);
  }

  void check_trace(const Json& trace) {
    const std::size_t steps = count(trace, "steps");
    expect_items("position", axes(trace, "position"), steps);
    const Json& truth = object(trace, "truth");
    expect_items("state", block(truth, "state", "u8").size(), steps);
    expect_items("triangle", block(truth, "triangle", "u32").size(), steps);
    expect_items("distance", block(truth, "distance", "f64").size(), steps);
    expect_items("point", axes(truth, "point"), steps);
    const Json& noted = object(trace, "noted");
    const std::vector<std::uint32_t> numbers = block(noted, "steps", "u32");
    expect_below("steps", numbers, steps);
    expect_items("probes", block(noted, "probes", "f64").size(), 5 * numbers.size());
    expect_below("around", block(noted, "around", "u32"), near_);
    std::size_t around = 0;
    for (const std::uint32_t one : block(noted, "around_counts", "u32")) around += one;
    expect_items("around", block(noted, "around", "u32").size(), around);
    const std::string trajectory = text(trace, "trajectory"), query = text(trace, "query");
    for (const Json& row : list(trace, "contestants")) check_row(row, trajectory, query, steps);
  }

  void check_row(const Json& row, const std::string& trajectory, const std::string& query,
                 std::size_t steps) {
    std::size_t asked = 0, end_before = 0;
    for (const Json& range : list(row, "ranges")) {
      if (!range.is_array() || range.size() != 2 || !range[0].is_number_unsigned() ||
          !range[1].is_number_unsigned())
        throw Damage{"ranges", "is not a list of pairs"};
      const auto begin = range[0].get<std::size_t>(), end = range[1].get<std::size_t>();
      if (begin < end_before || end <= begin || end > steps)
        throw Damage{"ranges", fmt::format("has {} to {} of {} steps", begin, end, steps)};
      asked += end - begin;
      end_before = end;
    }
    const Json& ns = object(row, "ns");
    const double low = number(ns, "low_ns"), high = number(ns, "high_ns");
    if (!(low > 0 && low <= high)) throw Damage{"low_ns", fmt::format("is {}, and high_ns {}", low, high)};
    expect_items("levels", block(ns, "levels", "u16").size(), asked);
    for (const char* const name : {"found", "charged"})
      expect_items(name, block(row, name, "u8").size(), asked);
    for (const char* const name : {"triangle", "work"})
      expect_items(name, block(row, name, "u32").size(), asked);
    expect_items("distance", block(row, "distance", "u64").size(), asked);
    const Json& noted = object(row, "noted");
    std::size_t noted_and_asked = 0;
    for (const std::uint32_t one : block(noted, "asked", "u8")) noted_and_asked += one;
    expect_items("ns", block(noted, "ns", "f64").size(), noted_and_asked);
    expect_items("answers", block(noted, "answers", "f64").size(), 8 * noted_and_asked);
    find_in_results({text(row, "detector"), text(row, "options"), trajectory, query}, asked, high);
  }

  /// The row of results.csv that this is of has as many steps, and the same largest time.
  void find_in_results(const std::vector<std::string>& key, std::size_t steps, double high_ns) {
    if (results_ == nullptr) return;
    for (const CsvRecord& record : results_->records) {
      if (results_->field(record, "detector") != key[0] || results_->field(record, "options") != key[1] ||
          results_->field(record, "trajectory") != key[2] || results_->field(record, "query") != key[3])
        continue;
      if (results_->field(record, "run_id") != run_id_) {
        if (!told_of_run_)
          faults_.push_back({path_, 0, "run_id", run_id_,
                             "is not that of results.csv, " + results_->field(record, "run_id")});
        told_of_run_ = true;
        return;
      }
      ++rows_found_;
      if (results_->field(record, "steps") != std::to_string(steps))
        faults_.push_back({path_, 0, fmt::format("{} on {}", key[0], key[2]), std::to_string(steps),
                           "steps, where results.csv has " + results_->field(record, "steps")});
      const std::optional<double> largest = support::parse_number(results_->field(record, "ns_max"));
      constexpr double printed_digits = 1e-4;
      if (largest && std::abs(*largest - high_ns) > printed_digits * high_ns)
        faults_.push_back({path_, 0, fmt::format("{} on {}", key[0], key[2]), fmt::format("{}", high_ns),
                           "ns at most, where results.csv has " + results_->field(record, "ns_max")});
      return;
    }
    faults_.push_back(
        {path_, 0, fmt::format("{} on {}", key[0], key[2]), key[1], "has no row in results.csv"});
  }

  /// Rows that were timed and are not too long are in the file.
  void check_all_rows_are_there() {
    if (results_ == nullptr || told_of_run_) return;
    std::size_t expected = 0;
    for (const CsvRecord& record : results_->records) {
      const std::optional<std::uint64_t> steps = support::parse_count(results_->field(record, "steps"));
      expected += !results_->field(record, "ns_max").empty() && steps && *steps <= max_steps_in_file ? 1 : 0;
    }
    if (rows_found_ != expected)
      faults_.push_back({path_, 0, "", "",
                         fmt::format("has {} of the {} timed rows of results.csv", rows_found_, expected)});
  }

  std::string path_, file_;
  const CsvTable* results_;
  Faults& faults_;
  Json header_;
  std::string_view blocks_;
  std::string run_id_;
  std::size_t near_ = 0, rows_found_ = 0;
  bool told_of_run_ = false;
};

}  // namespace

std::string check_steps(const std::string& path, const CsvTable* results, Faults& faults) {
  StepsCheck check(path, support::read_text_file(path), results, faults);
  std::size_t traces = 0;
  try {
    traces = check.run();
  } catch (const Damage& damage) {
    faults.push_back({path, 0, damage.where, "", damage.wrong});
  }
  return fmt::format("steps of {} trajectories", traces);
}

}  // namespace touchmark::bench::results::validation
