/// A stretch of a paced loop in the worker, with a contestant or with nothing asked. Runs in a worker.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

#include "bench/contestants/contestant.h"
#include "bench/contestants/guided_proxy.h"
#include "bench/workers/shared_workload.h"
#include "bench/workers/timing/paced_replay.h"
#include "bench/workers/worker_protocol.h"

namespace touchmark::bench::workers {

/// The tick records lie in the buffers then. The first stretch of the process locks its memory. The first
/// that steps a proxy makes it, of the contestant and its mesh, if it has one, and places it. `memory` is
/// walked over where caches are to be emptied: it has at least as many bytes as the request wants.
ServoStretch run_servo(contestants::Contestant& contestant, std::optional<contestants::GuidedProxy>& proxy,
                       const std::function<std::optional<TriangleMesh>()>& mesh,
                       const workload::QueryTrace& trace, const request::Servo& request,
                       const OutputBuffers& buffers, std::span<const std::byte> memory);

/// Steps the proxy after the goals that the pacer names; the clock is read before and after the whole step.
/// Before, bodies are moved to where they are at the goal's step, and what prepares does.
void step_paced(contestants::GuidedProxy& proxy, const workload::QueryTrace& trace,
                PacedReplay& pacer) noexcept;

}  // namespace touchmark::bench::workers
