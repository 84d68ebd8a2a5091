#include "bench/cli/worker_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/options.h"
#include "bench/support/checked.h"
#include "bench/support/numbers.h"

namespace touchmark::bench::cli {

void add_worker_selectors(CLI::App& command, WorkerSelectors& selectors) {
  add_value(command, "--timeout", selectors.timeout, "S",
            "seconds a contestant may take for one build or one pass before it is given up");
  command.add_flag("--worker-output", selectors.show_output, "let the contestants' libraries print");
}

workers::WorkerOptions worker_options(const WorkerSelectors& selectors) {
  workers::WorkerOptions options;
  options.show_output = selectors.show_output;
  if (selectors.timeout.empty()) return options;
  constexpr double max_s = 86400;
  const std::optional<double> seconds = support::parse_number(selectors.timeout);
  if (!seconds || !(*seconds > 0) || *seconds > max_s)
    throw support::bad_value("--timeout", selectors.timeout,
                             fmt::format("a time in seconds, above 0 and at most {}", max_s));
  options.build_timeout = options.request_timeout =
      std::chrono::milliseconds(static_cast<std::chrono::milliseconds::rep>(*seconds * 1000) + 1);
  return options;
}

}  // namespace touchmark::bench::cli
