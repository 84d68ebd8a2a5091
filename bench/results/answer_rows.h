/// Answers as CSV rows, one a step: what `touchmark query` prints.
#pragma once

#include <cstddef>
#include <string>

#include "bench/contestants/contestant.h"
#include "bench/scenes/body_scene.h"
#include "bench/workload/answer.h"

namespace touchmark::bench::results {

/// Which columns there are beside those of all queries.
struct AnswerColumns {
  bool side = false;                          ///< a contestant was asked for it
  const scenes::BodyScene* bodies = nullptr;  ///< a scene, whose bodies are named; null: no such column
};

/// Returns the header with its line end. All queries have these columns; `sweep` appends the fraction of the
/// way, then come the side and the body.
std::string answer_header(workload::Query query, const AnswerColumns& columns = {});

/// Appends a step's row. `touching` is 1 where the distance is at most the probe's radius (sweep: where it
/// was hit on the way); what the query does not tell or found nothing to tell about stays empty. Doubles in
/// the shortest form that reads back to the same bits. The body is that of the nearest triangle, also of a
/// touch, and stays empty where nothing is found.
void append_answer_row(std::string& rows, workload::Query query, std::size_t index,
                       const workload::Step& step, const workload::Answer& answer,
                       const AnswerColumns& columns = {});

}  // namespace touchmark::bench::results
