/// Whom a worker can build: its own contestants, or the one of a plug-in.
#pragma once

#include <optional>
#include <string>

#include "bench/contestants/roster.h"
#include "bench/workers/worker_protocol.h"

namespace touchmark::bench::workers {

/// Makes a contestant of a plug-in's file. Throws std::exception that says what is wrong with it.
using LoadPlugin = contestants::ContestantInfo (*)(const std::string& path);

class WorkerRoster {
 public:
  /// Without `load` plug-ins are refused. `own` must outlive it.
  WorkerRoster(const contestants::Roster& own, LoadPlugin load) : own_(own), load_(load) {}

  /// Throws std::exception where the plug-in is none, or the contestant's text names no contestant.
  contestants::ContestantSpec chosen(const request::Build& request);
  Described reply(const request::Describe& request);
  Reproduced reply(const request::Reproduce& request);

  const contestants::Roster& operator*() const noexcept { return plugin_ ? *plugin_ : own_; }
  const contestants::Roster* operator->() const noexcept { return &**this; }

 private:
  void ensure_loaded(const std::string& plugin);

  const contestants::Roster& own_;
  LoadPlugin load_;
  std::optional<contestants::Roster> plugin_;
};

}  // namespace touchmark::bench::workers
