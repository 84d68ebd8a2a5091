/// How every entry begins.
#pragma once

#include <string>
#include <utility>

#include "bench/contestants/contestant_info.h"

namespace touchmark::bench::contestants {

/// Returns an entry with what `touchmark list` says of it.
inline ContestantInfo introduced(std::string name, int rank, std::string summary, std::string accuracy) {
  ContestantInfo info;
  info.name = std::move(name);
  info.rank = rank;
  info.summary = std::move(summary);
  info.accuracy = std::move(accuracy);
  return info;
}

}  // namespace touchmark::bench::contestants
