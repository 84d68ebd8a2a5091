/// What the paper commands have in common on the command line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "bench/support/length.h"

namespace CLI {
class App;
}

namespace touchmark::bench::experiments::papers {

/// As given, still unchecked.
struct PaperOptions {
  std::string out;
  std::string radius;
  std::string steps;
  std::string seed = "1";
  bool quick = false;
};

/// `out` and `radius` hold the command's defaults.
void add_paper_options(CLI::App& command, PaperOptions& options);

// All throw std::invalid_argument naming the option and the value.

/// A finite length of 0 or more.
support::Length checked_finite_length(std::string_view option, const std::string& text);
/// A finite number above 0.
double checked_positive(std::string_view option, const std::string& text);
/// `least` to `most`; the default when the text is empty.
std::size_t checked_number(std::string_view option, const std::string& text, std::size_t least,
                           std::size_t most, std::size_t otherwise);
std::uint64_t checked_seed(const std::string& text);

}  // namespace touchmark::bench::experiments::papers
