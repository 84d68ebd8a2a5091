/// The worker program for plug-ins. It is linked with no detector, so that whatever a plug-in brings with it,
/// another version of a rival perhaps, meets nothing of its kind.
#include "bench/contestants/plugins/plugin_kind.h"
#include "bench/contestants/roster.h"
#include "bench/support/system/own_time.h"
#include "bench/workers/worker.h"

int main(int argc, char** argv) {
  touchmark::bench::support::others_may_work = true;
  const touchmark::bench::contestants::Roster nobody({});
  return touchmark::bench::workers::run_worker(argc, argv, nobody,
                                               touchmark::bench::contestants::load_plugin);
}
