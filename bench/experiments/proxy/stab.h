/// One stab through a groove and a thin wall by every method, for a picture that needs no explanation.
#pragma once

#include <string>
#include <vector>

#include "bench/contestants/roster.h"
#include "bench/proxies/course.h"
#include "bench/proxies/methods.h"

namespace touchmark::bench::experiments::proxy {

using proxies::Course, proxies::MethodSpec;

/// A ball of 2 mm over a block with a groove and a wall of half a millimetre: it is pressed below the
/// surface, drawn along under the groove, and jerked through the wall. All happens in the plane y = 0.
Course stab_course();

/// stab.csv: method, step, goal_x, goal_z, proxy_x, proxy_z, a row each position of the way; and first rows
/// of the method "surface", whose proxy_x and proxy_z are the outline of the cut at y = 0.
std::string stab_csv(const contestants::Roster& roster, const std::vector<MethodSpec>& methods,
                     const Coupling& coupling, const std::string& detector);

}  // namespace touchmark::bench::experiments::proxy
