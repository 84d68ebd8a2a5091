#include "bench/trajectories/motion_columns.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "bench/support/numbers.h"
#include "bench/trajectories/motion_field.h"
#include "bench/trajectories/motion_names.h"

namespace touchmark::bench::trajectories {
namespace {

using Fields = std::vector<std::string>;

constexpr std::size_t max_rows_above = 64;
constexpr const char* must_name = "it must name x, y and z, or --columns say which they are";

struct Row {
  Fields fields;
  std::size_t line = 0;
};

/// Returns the number of fields without blank ones at the end.
std::size_t count_of(const Fields& row) {
  const auto last = std::find_if(row.rbegin(), row.rend(),
                                 [](const std::string& field) { return !trimmed(field).empty(); });
  return static_cast<std::size_t>(row.rend() - last);
}

std::vector<ColumnChoice> choices_in(const ChosenColumns& chosen) {
  std::vector<ColumnChoice> choices(chosen.position.begin(), chosen.position.end());
  if (chosen.radius) choices.push_back(*chosen.radius);
  for (const auto& time : {chosen.time, chosen.time_rest})
    if (time) choices.push_back(time->column);
  return choices;
}

bool is_name(const ColumnChoice& choice) { return std::holds_alternative<std::string>(choice); }

/// True if the field is a word of a header or a note, not a number or a mark of a missing one.
bool is_word(std::string_view field) {
  constexpr std::array<std::string_view, 8> missing = {"NA",   "N/A",  "na",   "n/a",
                                                       "NULL", "null", "None", "none"};
  return support::has_words(field) && !support::is_number(field, ' ') &&
         std::ranges::find(missing, trimmed(field)) == missing.end();
}

class HeaderReader {
 public:
  HeaderReader(support::CsvReader& file, const std::optional<ChosenColumns>& chosen)
      : file_(file), chosen_(chosen) {
    if (chosen) choices_ = choices_in(*chosen);
    for (const ColumnChoice& choice : choices_)
      if (const auto* const name = std::get_if<std::string>(&choice)) wanted_.push_back(*name);
    if (!chosen) wanted_ = {"x", "y", "z"};
  }

  MotionColumns read(Fields& first_row) {
    Row row;
    std::optional<MotionColumns> columns;
    while (!columns && above_.size() < max_rows_above && next(row)) {
      columns = !wanted_.empty() ? below_a_header(row) : of_a_first_row(row);
      if (!columns) above_.push_back(row);
    }
    if (!columns) refuse();
    for (const Row& above : above_) expect_no_data(above, row.fields);
    first_row = std::move(row.fields);
    return *std::move(columns);
  }

 private:
  bool next(Row& row) {
    if (!read_row(file_, row.fields)) return false;
    row.line = file_.line();
    return true;
  }
  bool is_number(const std::string& field) const { return support::is_number(field, file_.separator()); }

  /// Returns the columns if these names are a header for them.
  std::optional<MotionColumns> named_by(const Fields& fields, std::size_t line) const {
    const MotionNames names(file_, fields, line);
    const auto has = [&](const ColumnChoice& choice) {
      return is_name(choice) ? names.find(std::get<std::string>(choice)).has_value()
                             : std::get<std::size_t>(choice) <= count_of(fields);
    };
    std::optional<MotionColumns> columns;
    if (!chosen_) columns = names.usual_columns();
    if (chosen_ && std::ranges::all_of(choices_, has)) columns = chosen_columns(names);
    if (!columns) return columns;
    columns->min_count = count_of(fields);
    columns->count = fields.size();
    columns->line = line;
    return columns;
  }
  /// Returns the columns if the row is a header, or a comment before it is. Then `row` is the row after it.
  std::optional<MotionColumns> below_a_header(Row& row) {
    std::optional<MotionColumns> columns = named_by(row.fields, row.line);
    if (columns) {
      if (!read_next_row(file_, row.fields)) row.fields.clear();
      row.line = file_.line();
      return columns;
    }
    for (const Row& names : names_in_comments(row.fields)) {
      columns = named_by(names.fields, names.line);
      if (!columns) continue;
      columns->count = std::max(columns->count, row.fields.size());
      break;
    }
    return columns;
  }

  /// Returns the columns if the row has numbers in all of them.
  std::optional<MotionColumns> of_a_first_row(const Row& row) const {
    const auto has_number = [&](const ColumnChoice& choice) {
      const std::size_t number = std::get<std::size_t>(choice);
      return number <= row.fields.size() && is_number(row.fields[number - 1]);
    };
    if (!std::ranges::all_of(choices_, has_number)) return std::nullopt;
    std::vector<Row> headers = names_in_comments(row.fields);
    if (headers.empty() && !above_.empty()) headers.push_back(above_.back());
    const Fields names = headers.empty() ? Fields() : headers.front().fields;
    MotionColumns columns = chosen_columns(MotionNames(file_, names, row.line));
    columns.min_count = count_of(row.fields);
    columns.count = row.fields.size();
    columns.line = row.line;
    if (names.empty() && !columns.time) guess_times(columns, row.fields);
    return columns;
  }

  MotionColumns chosen_columns(const MotionNames& names) const {
    MotionColumns columns;
    for (std::size_t axis = 0; axis < 3; ++axis)
      columns.position[axis] = names.column(chosen_->position[axis]);
    if (chosen_->radius) columns.radius = names.column(*chosen_->radius);
    if (chosen_->time) columns.time = names.time_column(*chosen_->time);
    if (chosen_->time_rest) columns.time_rest = names.time_column(*chosen_->time_rest);
    return columns;
  }

  /// Takes the first two columns as times if they hold whole seconds from 1990 to 2100 and nanoseconds.
  void guess_times(MotionColumns& columns, const Fields& row) const {
    const auto is_position = [](const MotionColumn& column) { return column.index < 2; };
    if (std::ranges::any_of(columns.position, is_position)) return;
    const auto seconds = support::parse_count(trimmed(row[0])), rest = support::parse_count(trimmed(row[1]));
    if (!seconds || decimals_of_date(static_cast<double>(*seconds)) != 0) return;
    if (!rest || *rest >= 1'000'000'000) return;
    columns.time = TimeColumn{{0, "1"}, 0};
    columns.time_rest = TimeColumn{{1, "2"}, 9};
    columns.guessed_times = true;
  }

  /// Returns the comments above the row, the last one first, as rows of as many names as the row has fields.
  std::vector<Row> names_in_comments(const Fields& row) const {
    std::vector<Row> found;
    const std::vector<support::CsvComment>& comments = file_.comments();
    for (auto comment = comments.rbegin(); comment != comments.rend(); ++comment) {
      for (const char separator : {file_.separator(), ',', ';', '\t', ' '}) {
        Fields names = support::split_fields(comment->text, separator);
        names.resize(count_of(names));
        // A mark that a program took for a name of its own.
        if (names.size() == row.size() + 1 && names.front().empty()) names.erase(names.begin());
        if (!support::has_words(comment->text) || names.size() < count_of(row) || names.size() > row.size())
          continue;
        found.push_back({std::move(names), comment->line});
        break;
      }
    }
    return found;
  }

  /// True if the row has more numbers than words, or no words, where the motion's first row has numbers.
  bool is_data(const Fields& row, const Fields& first) const {
    std::size_t words = 0, numbers = 0;
    for (std::size_t i = 0; i < std::min(row.size(), first.size()); ++i) {
      if (!is_number(first[i]) || trimmed(row[i]).empty()) continue;
      ++(is_word(row[i]) ? words : numbers);
    }
    return words == 0 || words < numbers;
  }

  void expect_no_data(const Row& above, const Fields& first) const {
    if (first.empty() || !is_data(above.fields, first)) return;
    if (wanted_.empty()) refuse_numbers(above);
    throw file_.error_at(above.line, fmt::format("the row {} has numbers, and stands above the header",
                                                 shown(fmt::format("{}", fmt::join(above.fields, ",")))));
  }

  bool looks_like_data(const Row& row) const { return is_data(row.fields, Fields(row.fields.size(), "0")); }
  /// No row is a header, or has the numbers. Refuses the one that comes nearest.
  [[noreturn]] void refuse() const {
    if (above_.empty()) throw file_.error("the file is empty: it needs a header that names x, y and z");
    const auto names_in = [&](const Row& row) {
      const MotionNames names(file_, row.fields, row.line);
      return std::ranges::count_if(wanted_,
                                   [&](const std::string& name) { return names.find(name).has_value(); });
    };
    if (!wanted_.empty())
      refuse_names(*std::ranges::max_element(
          above_, [&](const Row& a, const Row& b) { return names_in(a) < names_in(b); }));
    for (const Row& row : above_)
      if (looks_like_data(row)) refuse_numbers(row);
    throw file_.error_at(above_.back().line, "no row follows the header");
  }

  /// Refuses a row that lacks a column that is chosen by number, or has no number there.
  [[noreturn]] void refuse_numbers(const Row& row) const {
    std::string text;
    for (const ColumnChoice& choice : choices_) {
      const std::size_t* const number = std::get_if<std::size_t>(&choice);
      if (number == nullptr) continue;
      if (*number > row.fields.size())
        throw file_.error_at(
            row.line, fmt::format("--columns: there is no column {} of {}", *number, row.fields.size()));
      const std::string& field = row.fields[*number - 1];
      if (text.empty() && !is_number(field))
        text = fmt::format("column {}: {}", *number, no_number(field, file_.separator()));
    }
    throw file_.error_at(row.line, text);
  }

  /// Refuses a row that does not name all wanted columns.
  [[noreturn]] void refuse_names(const Row& row) const {
    const std::string text = shown(fmt::format("{}", fmt::join(row.fields, ",")));
    if (looks_like_data(row))
      throw file_.error_at(row.line,
                           fmt::format("the first row {} has numbers, and no line above it names {}: "
                                       "--columns x=COL,y=COL,z=COL takes columns by number",
                                       text, fmt::join(wanted_, ", ")));
    const MotionNames names(file_, row.fields, row.line);
    if (chosen_) {
      (void)chosen_columns(names);
      refuse_numbers(row);
    }
    const auto missing =
        std::ranges::find_if(wanted_, [&](const std::string& name) { return !names.find(name); });
    const std::string what = missing == wanted_.end() ? "" : " has no column " + *missing;
    throw file_.error_at(row.line, fmt::format("the header {}{}: {}", text, what, must_name));
  }

  support::CsvReader& file_;
  const std::optional<ChosenColumns>& chosen_;
  std::vector<ColumnChoice> choices_;
  std::vector<std::string> wanted_;  // names; empty if all columns are chosen by number
  std::vector<Row> above_;           // rows above the header, or above the first row
};

}  // namespace

bool read_next_row(support::CsvReader& file, std::vector<std::string>& row) {
  std::size_t empty_line = 0;
  while (file.next(row)) {
    if (count_of(row) > 0) {
      if (empty_line == 0) return true;
      throw file.error_at(empty_line, "the row is empty, and rows follow it");
    }
    if (row.size() > 1 && empty_line == 0) empty_line = file.line();
  }
  return false;
}

bool read_row(support::CsvReader& file, std::vector<std::string>& row) {
  do {
    if (!file.next(row)) return false;
  } while (count_of(row) == 0);
  return true;
}

MotionColumns read_motion_header(support::CsvReader& file, const std::optional<ChosenColumns>& chosen,
                                 std::vector<std::string>& first_row) {
  return HeaderReader(file, chosen).read(first_row);
}

}  // namespace touchmark::bench::trajectories
