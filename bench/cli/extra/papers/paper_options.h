/// What the paper commands have in common on the command line.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace touchmark::bench::cli {

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

}  // namespace touchmark::bench::cli
