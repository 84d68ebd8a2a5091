/// How roster.cpp ties the names of options on the command line to values of a detector's Options.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/available_memory.h"
#include "bench/contestant.h"
#include "bench/contestant_info.h"
#include "bench/remarks.h"
#include "core/sign/signed_detector.h"

namespace touchmark::bench {

/// Throws ResourceError when so much for each triangle is more than there is.
inline void require_memory_for(const TriangleMesh& mesh, double bytes_per_triangle) {
  require_memory(fmt::format("{} triangles at {} bytes each", mesh.size(), bytes_per_triangle),
                 bytes_per_triangle * static_cast<double>(mesh.size()));
}

/// Any of them keeps a copy of the triangles, and a structure over them.
inline constexpr double least_bytes_per_triangle = 150;

template <Detector D, Idle idle = Idle::wasted>
std::unique_ptr<Contestant> contestant(const TriangleMesh& mesh, const typename D::Options& options) {
  require_memory_for(mesh, least_bytes_per_triangle);
  return std::make_unique<ContestantOf<D, idle>>(D::build(mesh, options));
}

/// What a contestant may be asked besides contacts. On, the detector is wrapped; off, it is itself.
inline const char* const side_key = "side";

inline OptionInfo side_option() {
  return {side_key, OptionKind::choice, {"off", "on"}, "off", "on: contacts tell inside from outside"};
}

inline bool asks_for_side(const OptionValues& values) {
  const auto side = values.all().find(side_key);
  return side != values.all().end() && side->second == "on";
}

/// The same with the option above.
template <Detector D, Idle idle = Idle::wasted>
std::unique_ptr<Contestant> contestant(const TriangleMesh& mesh, const typename D::Options& options,
                                       const OptionValues& values) {
  return asks_for_side(values) ? contestant<Signed<D>, idle>(mesh, options)
                               : contestant<D, idle>(mesh, options);
}

/// And with what `remark_on(detector)` has to say of it, unless that is empty.
template <Detector D, class RemarkOn>
std::unique_ptr<Contestant> contestant(const TriangleMesh& mesh, const typename D::Options& options,
                                       const OptionValues& values, const RemarkOn& remark_on) {
  const auto say = [&](const D& detector) {
    if (std::string text = remark_on(detector); !text.empty()) remark(std::move(text));
  };
  if (asks_for_side(values)) {
    Signed<D> detector = Signed<D>::build(mesh, options);
    say(detector.detector());
    return std::make_unique<ContestantOf<Signed<D>>>(std::move(detector));
  }
  D detector = D::build(mesh, options);
  say(detector);
  return std::make_unique<ContestantOf<D>>(std::move(detector));
}

/// A choice's names with what they stand for. The first one is the default.
template <class Value>
using Names = std::vector<std::pair<std::string, Value>>;

template <class Value>
OptionInfo choice(std::string key, const Names<Value>& names, std::string summary) {
  OptionInfo option{std::move(key), OptionKind::choice, {}, names.front().first, std::move(summary)};
  for (const auto& [name, value] : names) option.choices.push_back(name);
  return option;
}

/// The roster has checked that the value is one of the names.
template <class Value>
Value chosen(const OptionValues& values, const std::string& key, const Names<Value>& names) {
  for (const auto& [name, value] : names) {
    if (name == values.text(key)) return value;
  }
  return names.front().second;
}

}  // namespace touchmark::bench
