/// `touchmark bench --suite`: many meshes, motions, questions and reaches, and one score.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "bench/cli/program.h"
#include "bench/cli/worker_options.h"
#include "bench/contestants/selectors.h"
#include "bench/measurement/effort.h"

namespace CLI {
class App;
}

namespace touchmark::bench::cli {

struct SuiteOptions {
  contestants::Selectors selectors;
  std::string out;
  std::string cells;                        ///< a mesh; empty: by the effort
  std::string minutes;                      ///< at most, about; empty: all cells, however long they take
  std::optional<std::size_t> cold_samples;  ///< none: by the effort
  bool quick = false;
  WorkerSelectors workers;
};

/// An exit status. Throws std::invalid_argument, MeshError or ResourceError.
int run_suite(const ProgramContext& context, const SuiteOptions& options);

/// Adds --suite and the options that go with it alone.
void add_suite(CLI::App& command, bool& suite, std::string& cells, std::string& minutes);

/// Throws std::invalid_argument for an option of `bench` that the suite chooses itself.
void expect_options_of_suite(const CLI::App& command);

}  // namespace touchmark::bench::cli
