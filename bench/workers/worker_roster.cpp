#include "bench/workers/worker_roster.h"

#include <exception>
#include <stdexcept>
#include <vector>

namespace touchmark::bench::workers {

/// A worker serves one contestant all its life, so what is loaded stays.
void WorkerRoster::ensure_loaded(const std::string& plugin) {
  if (plugin_) return;
  if (load_ == nullptr) throw std::invalid_argument("this worker loads no plug-ins");
  plugin_.emplace(std::vector{load_(plugin)});
}

contestants::ContestantSpec WorkerRoster::chosen(const request::Build& request) {
  if (!request.plugin.empty()) ensure_loaded(request.plugin);
  return (**this).parse(request.contestant);
}

Described WorkerRoster::reply(const request::Describe& request) {
  Described described;
  try {
    ensure_loaded(request.plugin);
  } catch (const std::exception& error) {
    described.refused = error.what();
    return described;
  }
  const contestants::ContestantInfo& info = plugin_->contestants().front();
  return {"", info.name, info.summary, info.accuracy, info.queries, info.options};
}

Reproduced WorkerRoster::reply(const request::Reproduce& request) {
  try {
    ensure_loaded(request.plugin);
    return {"", contestants::reproduction(request.question)};
  } catch (const std::exception& error) {
    return {error.what(), ""};
  }
}

}  // namespace touchmark::bench::workers
