#include "bench/workers/plugin_description.h"

#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "bench/contestants/plugins/plugin_kind.h"
#include "bench/workers/shared_memory.h"
#include "bench/workers/worker_process.h"

namespace touchmark::bench::workers {
namespace {

constexpr std::chrono::seconds timeout{20};

/// Its full path, so that the loader looks nowhere else.
std::string found_file(const std::string& path) {
  std::error_code error;
  const std::filesystem::path full = std::filesystem::canonical(path, error);
  if (error) throw std::invalid_argument(error.message());
  if (!std::filesystem::is_regular_file(full, error)) throw std::invalid_argument("it is not a file");
  return full.string();
}

Described ask(const std::string& file, const std::string& program) {
  // A worker finds its descriptors open, though there is nothing to be read yet.
  const SharedMemory input = SharedMemory::create(1), output = SharedMemory::create(1);
  WorkerProcess process({program, {}, input.descriptor(), output.descriptor(), {}, false, {}});
  try {
    return std::get<Described>(process.ask(request::Describe{file}, timeout));
  } catch (const WorkerFailure& failure) {
    throw std::invalid_argument(std::string("loading it ends in ") + failure.what());
  }
}

contestants::ContestantInfo info_of(Described described, const std::string& file,
                                    const std::string& program) {
  contestants::ContestantInfo info;
  info.name = std::move(described.name);
  info.summary = std::move(described.summary);
  info.accuracy = std::move(described.accuracy);
  info.queries = std::move(described.queries);
  info.options = std::move(described.options);
  info.plugin = file;
  info.worker_program = [program](const contestants::OptionValues&) { return program; };
  info.build = [](const TriangleMesh&,
                  const contestants::OptionValues&) -> std::unique_ptr<contestants::Contestant> {
    throw std::logic_error("plug-ins are built in workers");
  };
  return info;
}

}  // namespace

contestants::ContestantInfo described_plugin(const std::string& path) {
  const std::string file = found_file(path);
  const std::string program(contestants::plugin_kind_of(path).worker_program);
  Described described = ask(file, program);
  if (!described.refused.empty()) throw std::invalid_argument(described.refused);
  return info_of(std::move(described), file, program);
}

}  // namespace touchmark::bench::workers
