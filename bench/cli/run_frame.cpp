#include "bench/cli/run_frame.h"

#include <fmt/format.h>

#include "bench/cli/program.h"
#include "bench/support/system/denormals.h"
#include "bench/support/system/interrupt.h"

namespace touchmark::bench::cli {

RunFrame::RunFrame(const ProgramContext& context, const std::string& out)
    : description(results::begun_run(context.argc, context.argv)) {
  if (!out.empty()) folder.emplace(out);
  description.flushed_to_zero = support::restore_denormals();
}

bool RunFrame::finishes(const std::function<void()>& work) {
  support::watch_for_interrupts();
  try {
    work();
  } catch (const support::Interrupted&) {
    description.finished = false;
  }
  progress.clear();
  return description.finished;
}

int interrupted(const std::string& kept) {
  fmt::print(stderr, "touchmark: interrupted; {}\n", kept);
  return support::exit_interrupted;
}

int interrupted(std::size_t finished_rows) {
  return interrupted(fmt::format("{} finished rows are kept", finished_rows));
}

}  // namespace touchmark::bench::cli
