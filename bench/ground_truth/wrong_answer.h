/// An answer that was charged, with all that is needed to see what is wrong with it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "bench/oracle/judge.h"
#include "bench/oracle/oracle.h"
#include "bench/workload/answer.h"
#include "bench/workload/steps.h"

namespace touchmark::bench::ground_truth {

inline constexpr std::size_t wrong_answers_kept = 3;  ///< the maximum per row

struct WrongAnswer {
  std::size_t step = 0;  ///< its index in the trace
  workload::Query query = workload::Query::nearest;
  workload::Step asked;
  Vec3 from = Vec3::Zero();  ///< sweep: where it starts
  /// Ground truth at the probe; sweep: at the place where the answer says that the contact is made, undefined
  /// where it says none.
  oracle::GroundTruth truth;
  std::optional<TriangleId> triangle;  ///< the id of the truth's
  std::optional<std::uint32_t> body;   ///< the truth's, in a scene
  bool found = false;                  ///< should be: contact, within reach, a hit
  std::optional<Side> side;            ///< asked for, and on a closed mesh
  workload::Answer got;
  oracle::ErrorCounts charged;
};

/// What is wrong, each with how often: "2 distance, 1 triangle". Empty where nothing is.
std::string charges_of(const oracle::ErrorCounts& counts);

/// One line: the step, what is wrong, the probe, what was expected, what was got. Numbers as they are stored.
std::string described(const WrongAnswer& wrong);

}  // namespace touchmark::bench::ground_truth
