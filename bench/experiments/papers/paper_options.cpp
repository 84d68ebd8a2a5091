#include "bench/experiments/papers/paper_options.h"

#include <cmath>
#include <optional>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/support/numbers.h"

namespace touchmark::bench::experiments::papers {
namespace {

std::invalid_argument bad_value(std::string_view option, const std::string& value,
                                std::string_view expected) {
  return std::invalid_argument(fmt::format("{} \"{}\" is not {}", option, value, expected));
}

}  // namespace

void add_paper_options(CLI::App& command, PaperOptions& options) {
  command
      .add_option("--out,--output", options.out,
                  "folder for the CSV files, the report and the pictures' data")
      ->type_name("DIR")
      ->capture_default_str();
  command.add_option("--radius", options.radius, "the probe's, in mesh units or % of the box diagonal")
      ->type_name("LENGTH")
      ->capture_default_str();
  command.add_option("--steps", options.steps, "of the trajectory that every detector is given")
      ->type_name("N");
  command.add_option("--seed", options.seed, "of the trajectory and of the order of measuring")
      ->type_name("N")
      ->capture_default_str();
  command.add_flag("--quick", options.quick, "few steps, rounds and cases: to see that it works");
}

support::Length checked_finite_length(std::string_view option, const std::string& text) {
  const std::optional<support::Length> length = support::parse_length(text);
  if (!length || !std::isfinite(length->value)) {
    throw bad_value(option, text,
                    "a finite length: 0 or more in mesh units, or in percent of the box diagonal, as 0.5%");
  }
  return *length;
}

double checked_positive(std::string_view option, const std::string& text) {
  const std::optional<double> number = support::parse_number(text);
  if (!number || !(*number > 0) || !std::isfinite(*number)) throw bad_value(option, text, "a number above 0");
  return *number;
}

std::size_t checked_number(std::string_view option, const std::string& text, std::size_t least,
                           std::size_t most, std::size_t otherwise) {
  if (text.empty()) return otherwise;
  const std::optional<std::uint64_t> number = support::parse_count(text);
  if (!number || *number < least || *number > most)
    throw bad_value(option, text, fmt::format("a whole number from {} to {}", least, most));
  return *number;
}

std::uint64_t checked_seed(const std::string& text) {
  const std::optional<std::uint64_t> seed = support::parse_count(text);
  if (!seed) throw bad_value("--seed", text, "a whole number from 0 to 18446744073709551615");
  return *seed;
}

}  // namespace touchmark::bench::experiments::papers
