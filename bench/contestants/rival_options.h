/// The option that every rival takes, see baselines/README.md.
#pragma once

#include "baselines/reach.h"
#include "bench/contestants/entry.h"

namespace touchmark::bench::contestants {

inline const Names<baselines::Asking> askings{{"checked", baselines::Asking::checked},
                                              {"plain", baselines::Asking::plain}};

inline OptionInfo query_option() {
  return choice("query", askings,
                "checked: the mesh's box and the last contact's triangle first; plain: the rival at once");
}

inline baselines::Asking asking(const OptionValues& values) { return chosen(values, "query", askings); }

}  // namespace touchmark::bench::contestants
