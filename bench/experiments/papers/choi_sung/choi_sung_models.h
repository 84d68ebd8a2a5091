/// Choi & Sung on other models: they had a tooth, a clover and a hat, which are not at hand. Those here are
/// generated, of the same kind and about the size of the bunny, the same bits on every machine.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/experiments/papers/choi_sung/choi_sung.h"
#include "bench/experiments/papers/frontier.h"

namespace touchmark::bench::experiments::papers {

struct Model {
  std::string name;
  TriangleMesh mesh;
};

/// A molar with four cusps and two roots, a clover of four leaves, a hat with a brim: closed, 1,280
/// triangles.
std::vector<Model> choi_sung_models();

/// Runs the paper's experiment untimed on models with the same distance in parts of the box diagonal, and
/// fills `result.models` with its statements and `result.distances` with what distances do to it.
void add_models(std::span<const Model> models, const ChoiSungSettings& settings, double bunny_diagonal,
                ChoiSungResult& result, const PrintProgress& print_progress);

/// Adds the published scans of the exploration that differ in their distance of clustering alone.
void add_distances(const FrontierResult& frontier, ChoiSungResult& result);

}  // namespace touchmark::bench::experiments::papers
