/// Our proxy's ticks in the terms of the suite.
#pragma once

#include "bench/proxies/proxy_method.h"
#include "core/haptics/proxy_motion.h"

namespace touchmark::bench::proxies {

/// Writes what a tick of our proxy came to into the step.
void take(const ProxyState& state, Step& step);

}  // namespace touchmark::bench::proxies
