/// The touchmark program with nothing but bad contestants.
#include "bench/cli/program.h"
#include "tests/bench/workers/hostile_roster.h"

int main(int argc, char** argv) {
  return touchmark::bench::cli::run_program(argc, argv, touchmark::bench::workers::hostile_roster());
}
