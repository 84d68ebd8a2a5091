/// The contestants of a program, and what is chosen of them on the command line.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "bench/contestants/contestant_info.h"

namespace touchmark::bench::contestants {

/// All contestants, in the order of their ranks.
class Roster {
 public:
  explicit Roster(std::vector<ContestantInfo> contestants);

  const std::vector<ContestantInfo>& contestants() const noexcept { return contestants_; }
  /// Throws std::invalid_argument where there is one of its name.
  void add(ContestantInfo contestant);
  /// Throws std::invalid_argument; an unknown name's message lists the nearest ones.
  const ContestantInfo& find(const std::string& name) const;
  /// `NAME[:key=value,...]`, by a present or a former name. Throws std::invalid_argument naming the name, key
  /// or value that is wrong.
  ContestantSpec parse(const std::string& text) const;
  /// Parses each. Says on stderr what a former name means, and keeps one where it means another of the list.
  std::vector<ContestantSpec> parse_all(const std::vector<std::string>& texts) const;
  /// Returns these forms of all contestants that are built in.
  std::vector<ContestantSpec> forms(std::vector<std::string> Forms::*set) const;
  std::vector<ContestantSpec> default_set() const { return forms(&Forms::compared); }
  /// Returns the default set and the forms that only `verify` runs.
  std::vector<ContestantSpec> thorough_set() const;
  /// Returns those that `choose` measures: exact ones that answer the query.
  std::vector<ContestantSpec> candidates(workload::Query query) const;
  /// Returns those that it measures over a scene of bodies.
  std::vector<ContestantSpec> scene_candidates(workload::Query query) const;
  /// Does what is to be done before a clock starts and the contestant is built: loads its library, and throws
  /// ResourceError where there is less memory than it takes for so many triangles.
  void prepare_to_build(const ContestantSpec& spec, std::size_t triangles) const;
  /// Throws what the contestant's build throws, or std::invalid_argument when it is not built in.
  std::unique_ptr<Contestant> build(const ContestantSpec& spec, const TriangleMesh& mesh) const;
  std::unique_ptr<Contestant> build(const ContestantSpec& spec, const scenes::PlacedScene& scene) const;

 private:
  void sort();
  /// Throws std::invalid_argument, with the way out.
  const ContestantInfo& find_built(const std::string& name) const;
  /// Keeps those that claim exactness and answer the query.
  std::vector<ContestantSpec> exact_ones(std::vector<ContestantSpec> specs, workload::Query query) const;

  std::vector<ContestantInfo> contestants_;
};

}  // namespace touchmark::bench::contestants
