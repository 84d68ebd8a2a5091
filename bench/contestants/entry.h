/// What an entry is written with: it ties the names of options on the command line to values of a detector's
/// Options.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bench/contestants/build_notes.h"
#include "bench/contestants/contestant_info.h"
#include "bench/contestants/contestant_of.h"
#include "bench/meshes/displaced.h"
#include "core/named/detector_options.h"
#include "core/sign/signed_detector.h"

namespace touchmark::bench::contestants {

template <Detector D>
std::unique_ptr<Contestant> contestant(const TriangleMesh& mesh, const typename D::Options& options) {
  return std::make_unique<ContestantOf<D>>(D::build(mesh, options));
}

/// What a contestant may be asked besides contacts. On, the detector is wrapped; off, it is itself.
inline const char* const side_key = "side";

inline OptionInfo side_option() {
  bool side = false;
  return named::side_option(side);
}

inline bool asks_for_side(const OptionValues& values) {
  const auto side = values.all().find(side_key);
  return side != values.all().end() && side->second == "on";
}

/// Whether a detector is to have followed its mesh, for those that can: to verify updates by any question.
inline const char* const updated_key = "updated";

inline OptionInfo updated_option() {
  return {updated_key,
          OptionKind::choice,
          {"false", "true"},
          "false",
          "true: built of the mesh with some vertices elsewhere, asked, then updated to it"};
}

inline bool is_updated(const OptionValues& values) {
  const auto updated = values.all().find(updated_key);
  return updated != values.all().end() && updated->second == "true";
}

/// Built of the mesh, or made to follow it there. Before it does, it is asked here and there, so that
/// something of what is made later is there to be kept.
template <Detector D, class Options>
D built(const TriangleMesh& mesh, const Options& options, const OptionValues& values) {
  if constexpr (Updates<D> && AnswersNearest<D>) {
    if (is_updated(values)) {
      constexpr std::size_t max_asked = 500;
      D detector = D::build(meshes::displaced(mesh, 1), options);
      typename D::Session session;
      const std::span<const Vec3> vertices = mesh.vertices();
      for (std::size_t i = 0; i < vertices.size(); i += 1 + vertices.size() / max_asked)
        detector.nearest({vertices[i], 0}, std::numeric_limits<double>::infinity(), session);
      detector.update(mesh);
      return detector;
    }
  }
  return D::build(mesh, options);
}

/// Builds it with the options above, and with what `remark_on(detector)` has to say of it, unless that is
/// empty.
template <Detector D, Prefetch prefetch = Prefetch::off>
std::unique_ptr<Contestant> contestant(const TriangleMesh& mesh, const typename D::Options& options,
                                       const OptionValues& values,
                                       const std::function<std::string(const D&)>& remark_on = nullptr) {
  const auto with = [&]<Detector Built>(Built detector) -> std::unique_ptr<Contestant> {
    const D* plain;
    if constexpr (std::is_same_v<Built, D>) {
      plain = &detector;
    } else {
      plain = &detector.detector();
    }
    if (std::string text = remark_on ? remark_on(*plain) : ""; !text.empty()) remark(std::move(text));
    return std::make_unique<ContestantOf<Built, prefetch>>(std::move(detector));
  };
  return asks_for_side(values) ? with(built<Signed<D>>(mesh, options, values))
                               : with(built<D>(mesh, options, values));
}

/// As above, prepared for before each query where that was chosen.
template <Detector D>
std::unique_ptr<Contestant> prepared_contestant(
    const TriangleMesh& mesh, const typename D::Options& options, const OptionValues& values,
    const std::function<std::string(const D&)>& remark_on = nullptr) {
  return values.flag("prepare") ? contestant<D, Prefetch::on>(mesh, options, values, remark_on)
                                : contestant<D>(mesh, options, values, remark_on);
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

/// Returns what the chosen name stands for. The roster has checked that it is one of the names.
template <class Value>
Value chosen(const OptionValues& values, const std::string& key, const Names<Value>& names) {
  for (const auto& [name, value] : names)
    if (name == values.text(key)) return value;
  return names.front().second;
}

/// Returns a class that any options choose.
inline std::function<LibraryClass(const OptionValues&)> library_class(const char* header, const char* name) {
  return [=](const OptionValues&) { return LibraryClass{header, name}; };
}

inline const Names<bool> yes_or_no{{"true", true}, {"false", false}};

}  // namespace touchmark::bench::contestants
