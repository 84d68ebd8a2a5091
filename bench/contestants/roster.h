/// Every contestant this program was built with. A new one is one entry in roster.cpp.
#pragma once

#include "bench/contestants/contestant_info.h"

namespace touchmark::bench::contestants {

const Roster& roster();

}  // namespace touchmark::bench::contestants
