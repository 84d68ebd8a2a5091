#include "bench/regression/driver/cases.h"

#include <string_view>

namespace touchmark::bench::regression::driver {
namespace {

constexpr auto touches = touchmark_gate_touches;
constexpr auto nearest = touchmark_gate_nearest;
constexpr auto sweep = touchmark_gate_sweep;

// The steps of a timed case take about a millisecond, so that many rounds fit between two disturbances.
constexpr Case pinned[] = {
    {"grid-group", "bunny", "slide", nearest, 3'000, true},
    {"grid-group", "bunny", "approach", nearest, 20'000, true},
    {"grid-group", "bunny", "jump", nearest, 5'000, true},
    {"grid-group", "bunny", "slide", touches, 6'000, true},
    {"grid-group", "bunny", "slide", sweep, 600, true},
    {"sphere-cluster", "bunny", "slide", nearest, 3'000, true},
    {"sphere-cluster", "bunny", "approach", nearest, 20'000, true},
    {"sphere-cluster", "bunny", "jump", nearest, 6'000, true},
    {"sphere-cluster", "bunny", "slide", touches, 8'000, true},
    {"sphere-cluster", "bunny", "slide", sweep, 3'000, true},

    {"grid-group", "noisy-sphere:20000", "slide", nearest, 4'000, true},
    {"grid-group", "noisy-sphere:20000", "approach", nearest, 20'000, true},
    {"grid-group", "noisy-sphere:20000", "jump", nearest, 5'000, true},
    {"grid-group", "noisy-sphere:20000", "approach", touches, 20'000, true},
    {"grid-group", "noisy-sphere:20000", "slide", sweep, 1'000, true},
    {"sphere-cluster", "noisy-sphere:20000", "slide", nearest, 4'000, true},
    {"sphere-cluster", "noisy-sphere:20000", "approach", nearest, 20'000, true},
    {"sphere-cluster", "noisy-sphere:20000", "jump", nearest, 8'000, true},
    {"sphere-cluster", "noisy-sphere:20000", "approach", touches, 40'000, true},
    {"sphere-cluster", "noisy-sphere:20000", "slide", sweep, 4'000, true},
    {"aabb-tree", "noisy-sphere:20000", "slide", nearest, 1'000, true},
    {"aabb-tree", "noisy-sphere:20000", "jump", nearest, 3'000, true},
    {"aabb-tree", "noisy-sphere:20000", "slide", sweep, 400, true},

    {"brute-force", "noisy-sphere:1000", "slide", nearest, 20, true},
    {"brute-force", "noisy-sphere:1000", "slide", touches, 60, false},
    {"brute-force", "noisy-sphere:1000", "slide", sweep, 60, false},
    {"grid-group:lookup=scan", "noisy-sphere:1000", "slide", nearest, 300, true},
    {"grid-group:lookup=scan", "noisy-sphere:1000", "cross", sweep, 200, false},
    {"grid-group:lookup=scan,shape=sphere", "noisy-sphere:1000", "slide", nearest, 500, false},
    {"grid-group:lookup=scan,shape=sphere", "noisy-sphere:1000", "tap", touches, 500, false},
    // More groups than triangles: the published form tests them all, however much less brute force would do.
    {"grid-group:lookup=scan,groups=5000", "noisy-sphere:1000", "slide", nearest, 100, false},
    {"grid-group:lookup=scan,groups=5000", "noisy-sphere:1000", "cross", sweep, 100, false},
    {"grid-group:lookup=scan,shape=sphere,groups=5000", "noisy-sphere:1000", "tap", touches, 100, false},
    {"sphere-cluster:clustering=2%", "noisy-sphere:1000", "slide", nearest, 2'000, false},
    {"sphere-cluster:clustering=2%,lookup=scan", "noisy-sphere:1000", "slide", nearest, 200, true},
    {"sphere-cluster:clustering=2%,lookup=scan", "noisy-sphere:1000", "cross", sweep, 200, false},
    {"sphere-cluster:clustering=2%,precise=false", "noisy-sphere:1000", "tap", touches, 2'000, false},

    // The same as without `portable`, or a processor's wider instructions change what is found or looked at.
    {"sphere-cluster:portable", "noisy-sphere:20000", "slide", nearest, 4'000, false},
    {"sphere-cluster:portable", "noisy-sphere:20000", "approach", touches, 40'000, false},
    {"sphere-cluster:portable", "noisy-sphere:20000", "slide", sweep, 4'000, false},

    {"grid-group", "thin-plate", "edge", nearest, 2'000, false},
    {"grid-group", "thin-plate", "cross", sweep, 2'000, false},
    {"sphere-cluster", "thin-plate", "edge", nearest, 2'000, false},
    {"sphere-cluster", "thin-plate", "cross", sweep, 2'000, false},
    {"grid-group", "soup:2000", "hover", nearest, 2'000, false},
    {"grid-group", "soup:2000", "jump", touches, 2'000, false},
    {"sphere-cluster", "soup:2000", "hover", nearest, 2'000, false},
    {"sphere-cluster", "soup:2000", "jump", touches, 2'000, false},
};

const char* name_of(TouchmarkGateQuery query) {
  switch (query) {
    case touches:
      return "touches";
    case nearest:
      return "nearest";
    case sweep:
      return "sweep";
  }
  return "";
}

}  // namespace

std::string Case::name() const {
  return std::string(detector) + '/' + mesh + '/' + trajectory + '/' + name_of(query);
}

bool Case::needs_file() const { return std::string_view(mesh) == "bunny"; }

std::span<const Case> cases() { return pinned; }

}  // namespace touchmark::bench::regression::driver
