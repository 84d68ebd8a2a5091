#include "bench/results/steps_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/measurement/result_row.h"
#include "bench/meshes/drawn_mesh.h"
#include "bench/support/files/packed_blocks.h"
#include "bench/workload/query_name.h"
#include "bench/workload/sample_steps.h"
#include "bench/workload/workload.h"
#include "core/float_limits.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark::bench::results {
namespace {

// Which steps of a run are worth a look at everything about them, and the triangles around their probes.

/// How many of each row's slowest steps, and of its first wrong ones, are noted.
constexpr std::size_t slowest_noted = 10, wrong_noted = 20;
/// How many steps of a trace are noted at most: the rows' slowest first, then their second slowest, and so
/// on.
constexpr std::size_t max_noted = 240;

/// Returns the steps of the slowest answers, slowest first. Empty where the row was not timed.
std::vector<std::size_t> slowest_steps(const measurement::StepLog& log, std::size_t count) {
  std::vector<std::size_t> places(log.ns.size());
  std::iota(places.begin(), places.end(), 0);
  const std::size_t kept = std::min(count, places.size());
  std::partial_sort(
      places.begin(), places.begin() + static_cast<std::ptrdiff_t>(kept), places.end(),
      [&](std::size_t a, std::size_t b) { return log.ns[a] != log.ns[b] ? log.ns[a] > log.ns[b] : a < b; });
  places.resize(kept);
  for (std::size_t& place : places) place = workload::step_at(log.ranges, place);
  return places;
}

/// Returns the steps of one trace to be noted, ascending: `rows` are of this trace and have logs.
std::vector<std::size_t> noted_steps(const std::vector<const measurement::ResultRow*>& rows) {
  std::vector<std::vector<std::size_t>> wishes;
  for (const measurement::ResultRow* row : rows) {
    wishes.push_back(slowest_steps(*row->log, slowest_noted));
    std::vector<std::size_t>& wrong = wishes.emplace_back();
    const std::vector<std::uint8_t>& charged = row->log->charged;
    for (std::size_t i = 0; i < charged.size() && wrong.size() < wrong_noted; ++i)
      if (charged[i] != 0) wrong.push_back(workload::step_at(row->log->ranges, i));
  }
  std::set<std::size_t> noted;
  for (std::size_t turn = 0; turn < std::max(slowest_noted, wrong_noted); ++turn)
    for (const std::vector<std::size_t>& wish : wishes)
      if (turn < wish.size() && noted.size() < max_noted) noted.insert(wish[turn]);
  return {noted.begin(), noted.end()};
}

/// The triangles around probes, each once, with corners in the mesh's own numbers.
class Surroundings {
 public:
  explicit Surroundings(const TriangleMesh& mesh) : places_(mesh.size()) {
    if (mesh.size() <= max_triangles)  // where ids are places in the mesh
      detector_.emplace(
          SphereCluster::build(TriangleMesh({mesh.vertices().begin(), mesh.vertices().end()},
                                            {mesh.triangles().begin(), mesh.triangles().end()})));
  }

  /// Returns the triangles nearest to the centre, as places in triangles(): at most `triangles_around`. None
  /// of a mesh so large that a page would wait for them.
  std::vector<std::uint32_t> around(const Vec3& center) {
    std::vector<std::uint32_t> around;
    if (!center.allFinite() || !detector_) return around;
    std::array<Contact, triangles_around> near;
    const std::size_t count = detector_->nearest_contacts({center, 0}, infinity, session_, near);
    for (const Contact& contact : std::span(near).first(count)) {
      std::uint32_t& place = places_[contact.triangle];
      if (place == 0) {
        chosen_.push_back(contact.triangle);
        place = static_cast<std::uint32_t>(chosen_.size());
      }
      around.push_back(place - 1);
    }
    return around;
  }

  /// Their positions in the mesh.
  const std::vector<std::uint32_t>& triangles() const noexcept { return chosen_; }

 private:
  static constexpr std::size_t triangles_around = 48;
  static constexpr std::size_t max_triangles = 2'000'000;

  std::optional<SphereCluster> detector_;
  SphereCluster::Session session_;
  std::vector<std::uint32_t> chosen_;
  std::vector<std::uint32_t>
      places_;  ///< a triangle of the mesh each: its place in chosen_, from 1; 0: not chosen
};

using measurement::ResultRow;
using Json = nlohmann::ordered_json;

Json json_of(const support::PackedBlock& block) {
  return {{"offset", block.offset},
          {"bytes", block.bytes},
          {"items", block.items},
          {"type", (block.real ? "f" : "u") + std::to_string(8 * block.item_bytes)},
          {"delta", block.delta}};
}

Json json_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// A box whose places are told by 16 bits an axis; 65535 is what lies in no box.
class Grid {
 public:
  static constexpr double cells = 65534;
  static constexpr std::uint16_t nowhere = 65535;

  void include(const Vec3& point) {
    if (!point.allFinite()) return;
    low_ = empty_ ? point : Vec3(low_.cwiseMin(point));
    high_ = empty_ ? point : Vec3(high_.cwiseMax(point));
    empty_ = false;
  }
  void append(const Vec3& point, std::vector<std::uint16_t> (&axes)[3]) const {
    for (int axis = 0; axis < 3; ++axis) {
      const double extent =
          high_[axis] / 2 - low_[axis] / 2;  // halves, since the whole may be beyond doubles
      const double share = extent > 0 ? (point[axis] / 2 - low_[axis] / 2) / extent : 0;
      axes[axis].push_back(point.allFinite()
                               ? static_cast<std::uint16_t>(std::lround(cells * std::clamp(share, 0.0, 1.0)))
                               : nowhere);
    }
  }
  Json low() const { return json_of(low_); }
  Json high() const { return json_of(high_); }

 private:
  Vec3 low_ = Vec3::Zero(), high_ = Vec3::Zero();
  bool empty_ = true;
};

class StepsFile {
 public:
  StepsFile(const workload::Workload& workload, const std::vector<ResultRow>& rows,
            const std::vector<std::vector<ground_truth::StepTruth>>& truths)
      : workload_(workload), rows_(rows), truths_(truths), surroundings_(workload.mesh) {}

  std::string text(const std::string& run_id) {
    Json header;
    header["schema"] = steps_version;
    header["run_id"] = run_id;
    header["traces"] = Json::array();
    for (std::size_t trace = 0; trace < workload_.traces.size(); ++trace) {
      const std::vector<const ResultRow*> rows = rows_of(trace);
      if (!rows.empty()) header["traces"].push_back(trace_json(trace, rows));
    }
    header["mesh"] = mesh_json();
    const std::string json = header.dump();
    std::string file(steps_magic);
    append(file, steps_version);
    append(file, static_cast<std::uint32_t>(json.size()));
    return file + json + packer_.bytes();
  }

 private:
  static void append(std::string& file, std::uint32_t number) {
    for (int byte = 0; byte < 4; ++byte) file.push_back(static_cast<char>(number >> (8 * byte) & 0xff));
  }

  std::vector<const ResultRow*> rows_of(std::size_t trace) const {
    std::vector<const ResultRow*> rows;
    for (const ResultRow& row : rows_)
      if (row.trajectory == workload_.trajectories[trace] && row.log != nullptr && !row.log->ns.empty())
        rows.push_back(&row);
    return rows;
  }

  template <class T>
  Json block(const std::vector<T>& items) {
    return json_of(packer_.add(std::span<const T>(items)));
  }
  Json axes(const std::vector<std::uint16_t> (&coordinates)[3]) {
    Json blocks = Json::array();
    for (const std::vector<std::uint16_t>& axis : coordinates)
      blocks.push_back(json_of(packer_.add(std::span<const std::uint16_t>(axis), true)));
    return blocks;
  }

  /// The coarse mesh to be drawn, and the triangles around noted steps as they are.
  Json mesh_json() {
    const TriangleMesh& mesh = workload_.mesh;
    const meshes::DrawnMesh drawn = meshes::drawn_mesh(mesh, max_drawn_triangles);
    Grid grid;
    for (const Vec3& vertex : drawn.vertices) grid.include(vertex);
    std::vector<std::uint16_t> vertices[3];
    for (const Vec3& vertex : drawn.vertices) grid.append(vertex, vertices);
    std::vector<std::uint32_t> corners;
    for (const std::array<std::uint32_t, 3>& triangle : drawn.triangles)
      corners.insert(corners.end(), triangle.begin(), triangle.end());

    std::map<std::uint32_t, std::uint32_t> numbers;
    std::vector<std::uint32_t> ids, near_corners;
    std::vector<double> near_vertices;
    for (const std::uint32_t triangle : surroundings_.triangles()) {
      ids.push_back(mesh.id(triangle));
      for (const std::uint32_t vertex : mesh.triangles()[triangle]) {
        const auto [found, fresh] = numbers.try_emplace(vertex, static_cast<std::uint32_t>(numbers.size()));
        near_corners.push_back(found->second);
        const Vec3& place = mesh.vertices()[vertex];
        if (fresh) near_vertices.insert(near_vertices.end(), {place.x(), place.y(), place.z()});
      }
    }
    const Aabb& bounds = mesh.bounds();
    return {{"name", workload_.mesh_name},
            {"triangles", mesh.size()},
            {"diagonal", mesh.diagonal()},
            {"low", json_of(bounds.min)},
            {"high", json_of(bounds.max)},
            {"drawn",
             {{"triangles", drawn.triangles.size()},
              {"low", grid.low()},
              {"high", grid.high()},
              {"vertices", axes(vertices)},
              {"corners", json_of(packer_.add(std::span<const std::uint32_t>(corners), true))}}},
            {"near",
             {{"ids", block(ids)}, {"corners", block(near_corners)}, {"vertices", block(near_vertices)}}}};
  }
  Json trace_json(std::size_t trace, const std::vector<const ResultRow*>& rows) {
    const std::vector<workload::Step>& steps = workload_.traces[trace];
    const std::vector<ground_truth::StepTruth>& truth = truths_[trace];
    Grid grid;
    for (const workload::Step& step : steps) grid.include(step.probe.center);
    for (const ground_truth::StepTruth& one : truth)
      if (one.known) grid.include(one.point);
    std::vector<std::uint16_t> positions[3];
    for (const workload::Step& step : steps) grid.append(step.probe.center, positions);
    const std::vector<std::size_t> noted = noted_steps(rows);
    Json json;
    json["trajectory"] = workload_.trajectories[trace];
    json["query"] = workload::name_of(rows.front()->query);
    json["steps"] = steps.size();
    json["radius"] = rows.front()->radius;
    json["reach"] = std::isfinite(rows.front()->reach) ? Json(rows.front()->reach) : Json("inf");
    json["low"] = grid.low();
    json["high"] = grid.high();
    json["position"] = axes(positions);
    json["truth"] = truth_json(grid, truth);
    json["noted"] = noted_json(trace, noted);
    json["contestants"] = Json::array();
    for (const ResultRow* row : rows) json["contestants"].push_back(row_json(*row, truth, noted));
    return json;
  }

  Json truth_json(const Grid& grid, const std::vector<ground_truth::StepTruth>& truth) {
    std::vector<std::uint8_t> state;
    std::vector<std::uint32_t> triangle;
    std::vector<double> distance;
    std::vector<std::uint16_t> point[3];
    for (const ground_truth::StepTruth& one : truth) {
      state.push_back(static_cast<std::uint8_t>((one.known ? 1 : 0) + (one.found ? 2 : 0)));
      triangle.push_back(one.triangle);
      distance.push_back(one.distance);
      grid.append(one.point, point);
    }
    return {{"state", block(state)},
            {"triangle", json_of(packer_.add(std::span<const std::uint32_t>(triangle), true))},
            {"distance", block(distance)},
            {"point", axes(point)}};
  }

  Json noted_json(std::size_t trace, const std::vector<std::size_t>& steps) {
    std::vector<std::uint32_t> numbers, counts, triangles;
    std::vector<double> probes;
    for (const std::size_t step : steps) {
      const workload::Step& asked = workload_.traces[trace][step];
      const Vec3& center = asked.probe.center;
      numbers.push_back(static_cast<std::uint32_t>(step));
      probes.insert(probes.end(), {center.x(), center.y(), center.z(), asked.probe.radius, asked.reach});
      const std::vector<std::uint32_t> around = surroundings_.around(center);
      counts.push_back(static_cast<std::uint32_t>(around.size()));
      triangles.insert(triangles.end(), around.begin(), around.end());
    }
    return {{"steps", json_of(packer_.add(std::span<const std::uint32_t>(numbers), true))},
            {"probes", block(probes)},
            {"around_counts", block(counts)},
            {"around", json_of(packer_.add(std::span<const std::uint32_t>(triangles), true))}};
  }

  Json row_json(const ResultRow& row, const std::vector<ground_truth::StepTruth>& truth,
                const std::vector<std::size_t>& noted) {
    const measurement::StepLog& log = *row.log;
    std::vector<std::uint8_t> found;
    std::vector<std::uint32_t> triangle, work;
    std::vector<std::uint64_t> distance;
    Json ranges = Json::array();
    std::size_t place = 0;
    for (const workload::StepRange& range : log.ranges) {
      ranges.push_back({range.begin, range.end});
      for (std::size_t step = range.begin; step < range.end; ++step, ++place) {
        const workload::Answer& answer = log.answers[place];
        // Against the truth, so that right answers are zeros.
        const bool told = answer.found != 0 && row.query == workload::Query::nearest;
        found.push_back(answer.found != 0 ? 1 : 0);
        triangle.push_back(told ? answer.triangle ^ truth[step].triangle : 0);
        distance.push_back(told ? std::bit_cast<std::uint64_t>(answer.distance) ^
                                      std::bit_cast<std::uint64_t>(truth[step].distance)
                                : 0);
        work.push_back(static_cast<std::uint32_t>(
            std::min<std::uint64_t>(log.work[place], std::numeric_limits<std::uint32_t>::max())));
      }
    }
    return {{"detector", row.detector},
            {"options", row.options},
            {"repeat", row.repeat},
            {"ranges", std::move(ranges)},
            {"ns", times_json(log.ns)},
            {"found", block(found)},
            {"triangle", block(triangle)},
            {"distance", block(distance)},
            {"work", block(work)},
            {"charged", block(log.charged)},
            {"noted", noted_answers(log, noted)}};
  }

  /// Sixteen bits a time, on a log scale between the least and the largest.
  Json times_json(const std::vector<double>& ns) {
    constexpr double least = 1e-3;  // ns: a clock that did not move
    constexpr double largest_level = 65535;
    const auto [first, last] = std::ranges::minmax_element(ns);
    const double low = std::max(*first, least), high = std::max(*last, low);
    std::vector<std::uint16_t> levels;
    for (const double one : ns) {
      const double level = high > low ? std::log(std::max(one, low) / low) / std::log(high / low) : 0;
      levels.push_back(static_cast<std::uint16_t>(std::lround(largest_level * level)));
    }
    return {{"low_ns", low}, {"high_ns", high}, {"levels", block(levels)}};
  }

  /// The answers to those of the noted steps that the row has, in the order of the steps.
  Json noted_answers(const measurement::StepLog& log, const std::vector<std::size_t>& noted) {
    std::vector<std::uint8_t> asked;
    std::vector<double> ns, answers;
    for (const std::size_t step : noted) {
      const auto holds = [step](const workload::StepRange& range) {
        return range.begin <= step && step < range.end;
      };
      asked.push_back(std::ranges::any_of(log.ranges, holds) ? 1 : 0);
      if (asked.back() == 0) continue;
      const std::size_t place = workload::place_in(log.ranges, step);
      const workload::Answer& answer = log.answers[place];
      ns.push_back(log.ns[place]);
      answers.insert(answers.end(), {answer.distance, answer.point[0], answer.point[1], answer.point[2],
                                     answer.normal[0], answer.normal[1], answer.normal[2], answer.fraction});
    }
    return {{"asked", block(asked)}, {"ns", block(ns)}, {"answers", block(answers)}};
  }

  const workload::Workload& workload_;
  const std::vector<ResultRow>& rows_;
  const std::vector<std::vector<ground_truth::StepTruth>>& truths_;
  Surroundings surroundings_;
  support::BlockPacker packer_;
};

}  // namespace

std::string steps_file(const std::string& run_id, const workload::Workload& workload,
                       const std::vector<ResultRow>& rows,
                       const std::vector<std::vector<ground_truth::StepTruth>>& truths) {
  return StepsFile(workload, rows, truths).text(run_id);
}

}  // namespace touchmark::bench::results
