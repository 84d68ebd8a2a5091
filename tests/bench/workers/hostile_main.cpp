/// The touchmark program with nothing but bad contestants.
#include "bench/cli/extra/extra_commands.h"
#include "tests/bench/workers/hostile_roster.h"

int main(int argc, char** argv) {
  namespace bench = touchmark::bench;
  return bench::cli::run_program(argc, argv, bench::workers::hostile_roster(), bench::cli::all_parts());
}
