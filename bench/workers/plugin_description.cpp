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

/// Asks a worker that lives for one request.
template <class Request>
typename Request::Reply ask(const Request& request) {
  const std::string program(contestants::plugin_kind_of(request.plugin).worker_program);
  // A worker finds its descriptors open, though there is nothing to be read yet.
  const SharedMemory input = SharedMemory::create(1), output = SharedMemory::create(1);
  WorkerProcess process({program, {}, input.descriptor(), output.descriptor(), {}, false, {}});
  try {
    return std::get<typename Request::Reply>(process.ask(request, timeout));
  } catch (const WorkerFailure& failure) {
    throw std::invalid_argument(std::string("loading it ends in ") + failure.what());
  }
}

contestants::ContestantInfo info_of(Described described, const std::string& file) {
  contestants::ContestantInfo info;
  info.name = std::move(described.name);
  info.summary = std::move(described.summary);
  info.accuracy = std::move(described.accuracy);
  info.queries = std::move(described.queries);
  info.options = std::move(described.options);
  info.plugin = file;
  info.worker_program = [program = std::string(contestants::plugin_kind_of(file).worker_program)](
                            const contestants::OptionValues&) { return program; };
  info.build = [](const TriangleMesh&,
                  const contestants::OptionValues&) -> std::unique_ptr<contestants::Contestant> {
    throw std::logic_error("plug-ins are built in workers");
  };
  return info;
}

}  // namespace

contestants::ContestantInfo described_plugin(const std::string& path) {
  const std::string file = found_file(path);
  Described described = ask(request::Describe{file});
  if (!described.refused.empty()) throw std::invalid_argument(described.refused);
  return info_of(std::move(described), file);
}

std::string reproduction(const std::string& path, const TriangleMesh& mesh, workload::Query query,
                         const Vec3& from, const workload::Step& step) {
  contestants::ReproducedQuestion asked;
  asked.query = query;
  for (const Vec3& vertex : mesh.vertices())
    asked.coordinates.insert(asked.coordinates.end(), vertex.begin(), vertex.end());
  for (const TriangleMesh::Corners& corners : mesh.triangles())
    asked.corners.insert(asked.corners.end(), corners.begin(), corners.end());
  const Vec3& center = step.probe.center;
  const double radius = step.probe.radius;
  asked.values = {center.x(), center.y(), center.z(),
                  query == workload::Query::nearest ? step.reach : radius};
  if (query == workload::Query::sweep)
    asked.values = {from.x(), from.y(), from.z(), center.x(), center.y(), center.z(), radius};
  Reproduced made = ask(request::Reproduce{found_file(path), std::move(asked)});
  if (!made.refused.empty()) throw std::invalid_argument(made.refused);
  return std::move(made.script);
}

}  // namespace touchmark::bench::workers
