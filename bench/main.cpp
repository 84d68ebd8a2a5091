#include "bench/cli/program.h"
#include "bench/contestants/built_in.h"

int main(int argc, char** argv) {
  namespace bench = touchmark::bench;
  return bench::cli::run_program(argc, argv, bench::contestants::roster(), {bench::cli::main_commands()});
}
