/// What `touchmark proxy` tells on the terminal and leaves beside proxy.csv.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/experiments/proxy/proxy_run.h"
#include "bench/results/run_json.h"

namespace touchmark::bench::experiments::proxy {

/// Two tables: crossings per million ticks by method and family, and everything else by method.
std::string proxy_table(const std::vector<Score>& scores);

/// Names the first tick that crossed of every method that claims never to; empty: there is none.
std::string proxy_faults(const std::vector<Score>& scores);

/// The coupling as run.json has it, but for the radius.
nlohmann::ordered_json coupling_json(const Coupling& coupling);

std::string proxy_json(const results::RunDescription& description, const ProxyRun& run);

}  // namespace touchmark::bench::experiments::proxy
