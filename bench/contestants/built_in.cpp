#include "bench/contestants/built_in.h"

#include <utility>

namespace touchmark::bench::contestants {

const Roster& roster() {
  static const Roster all([] {
    std::vector<ContestantInfo> entries = own_entries();
    for (ContestantInfo& entry : entries) entry.ours = true;
    for (ContestantInfo& entry : rival_entries()) entries.push_back(std::move(entry));
    return entries;
  }());
  return all;
}

}  // namespace touchmark::bench::contestants
