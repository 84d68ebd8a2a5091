/// A worker program. Which baselines it can run is a matter of what it is linked with.
#include "bench/roster.h"
#include "bench/worker.h"

int main(int argc, char** argv) {
  return touchmark::bench::run_worker(argc, argv, touchmark::bench::roster());
}
