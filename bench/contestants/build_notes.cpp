#include "bench/contestants/build_notes.h"

#include <algorithm>
#include <utility>

namespace touchmark::bench::contestants {
namespace {

std::vector<std::string>& kept() {
  static std::vector<std::string> remarks;
  return remarks;
}

}  // namespace

void remark(std::string text) {
  if (std::ranges::find(kept(), text) == kept().end()) kept().push_back(std::move(text));
}

std::vector<std::string> take_remarks() { return std::exchange(kept(), {}); }

}  // namespace touchmark::bench::contestants
