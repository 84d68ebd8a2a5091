#include "bench/cli/report_files.h"

#include <CLI/CLI.hpp>

#include "bench/cli/options.h"

namespace touchmark::bench::cli {

void add_junit(CLI::App& command, ReportSelectors& selectors) {
  add_value(command, "--junit", selectors.junit, "FILE", "JUnit XML of what was checked, for CI systems");
}

void add_markdown(CLI::App& command, ReportSelectors& selectors) {
  add_value(command, "--markdown", selectors.markdown, "FILE",
            "a summary in Markdown, for the summary of a CI step");
}

std::string code_block(const std::string& text) {
  return text.empty() ? "" : "\n````text\n" + text + (text.ends_with('\n') ? "" : "\n") + "````\n";
}

}  // namespace touchmark::bench::cli
