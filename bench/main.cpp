#include "bench/cli/program.h"
#include "bench/contestants/roster.h"

int main(int argc, char** argv) {
  return touchmark::bench::cli::run_program(argc, argv, touchmark::bench::contestants::roster());
}
