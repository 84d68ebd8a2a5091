/// A worker program. Which baselines it can run is a matter of what it is linked with.
#include "bench/contestants/built_in.h"
#include "bench/workers/worker.h"

int main(int argc, char** argv) {
  return touchmark::bench::workers::run_worker(argc, argv, touchmark::bench::contestants::roster());
}
