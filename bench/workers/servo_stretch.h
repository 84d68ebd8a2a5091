/// A stretch of a paced loop in the worker, with a contestant or with nothing asked. Runs in a worker.
#pragma once

#include "bench/contestants/contestant.h"
#include "bench/workers/shared_workload.h"
#include "bench/workers/worker_protocol.h"

namespace touchmark::bench::workers {

/// The tick records lie in the buffers then. The first stretch of the process locks its memory.
ServoStretch run_servo(contestants::Contestant& contestant, const workload::QueryTrace& trace,
                       const request::Servo& request, const OutputBuffers& buffers);

}  // namespace touchmark::bench::workers
