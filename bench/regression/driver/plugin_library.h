/// A loaded plug-in: one build of the core.
#pragma once

#include <memory>
#include <string>

#include "bench/regression/driver/plugin.h"

namespace touchmark::bench::regression::driver {

/// Never unloaded: a detector may outlive it.
class PluginLibrary {
 public:
  struct Destroy {
    decltype(&touchmark_gate_destroy) destroy = nullptr;
    void operator()(TouchmarkGateDetector* detector) const { destroy(detector); }
  };
  using Detector = std::unique_ptr<TouchmarkGateDetector, Destroy>;

  /// Files of different names are loaded apart, even when one is a copy of the other. Throws
  /// std::invalid_argument for a file that is no plug-in.
  explicit PluginLibrary(const std::string& path);

  /// Throws std::runtime_error, with the core's own words, when it refuses.
  Detector build(const std::string& name, const TouchmarkGateMesh& mesh) const;
  TouchmarkGateResult answer(const Detector& detector, const TouchmarkGatePass& pass) const;
  TouchmarkGateResult replay(const Detector& detector, const TouchmarkGatePass& pass) const;

 private:
  decltype(&touchmark_gate_build) build_;
  decltype(&touchmark_gate_answer) answer_;
  decltype(&touchmark_gate_replay) replay_;
  decltype(&touchmark_gate_destroy) destroy_;
};

}  // namespace touchmark::bench::regression::driver
