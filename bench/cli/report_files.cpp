#include "bench/cli/report_files.h"

#include <CLI/CLI.hpp>

namespace touchmark::bench::cli {

void add_junit(CLI::App& command, ReportSelectors& selectors) {
  command.add_option("--junit", selectors.junit, "JUnit XML of what was checked, for CI systems")
      ->type_name("FILE");
}

void add_markdown(CLI::App& command, ReportSelectors& selectors) {
  command.add_option("--markdown", selectors.markdown, "a summary in Markdown, for the summary of a CI step")
      ->type_name("FILE");
}

std::string code_block(const std::string& text) {
  return text.empty() ? "" : "\n````text\n" + text + (text.ends_with('\n') ? "" : "\n") + "````\n";
}

}  // namespace touchmark::bench::cli
