#include "bench/experiments/proxy/families.h"

#include <array>

#include "bench/experiments/proxy/course_makers.h"
#include "bench/support/did_you_mean.h"

namespace touchmark::bench::experiments::proxy {
namespace {

// One line a family.
constexpr std::array all_families{
    Family{"thin-plates", "plates from a centimetre down to one ulp thick, stabbed and pressed",
           &thin_plates},
    Family{"wedges-inside", "grooves of 1 to 179 degrees, the ball in them", &wedges_inside},
    Family{"wedges-outside", "blades of 1 to 179 degrees", &wedges_outside},
    Family{"corners", "three planes that meet in any directions, the ball between them", &corners},
    Family{"rooms", "boxes from inside, the goal outside beyond faces, edges and corners", &rooms},
    Family{"saddles", "saddles, coarse and fine", &saddles},
    Family{"convex-edges", "cubes and icospheres slid over", &convex_edges},
    Family{"cracks", "plates side by side with a crack of one ulp up to an edge's length", &cracks},
    Family{"needle-fans", "fans of needles, needles and caps", &needle_fans},
    Family{"t-junctions", "coarse squares beside fine ones, their vertices on edges only to rounding",
           &t_junctions},
    Family{"holes", "surfaces with a tenth of their triangles missing", &holes},
    Family{"self-intersections", "solids that pass through one another, and a soup", &self_intersections},
    Family{"doubled-faces", "triangles three times, and degenerate ones", &doubled_faces},
    Family{"scaled", "the same bumpy ball from 1 cm to 10 m", &scaled_meshes},
    Family{"stabs", "straight through solids at 100 diagonals a second", &stabs},
    Family{"rest-inside", "the goal at rest deep inside", &rest_inside},
    Family{"circles", "the goal circles in and out, always the same way", &circles},
    Family{"tremor", "a hand's tremor inside and at the surface", &tremors},
    Family{"friction", "friction of 0.1 to 1", &friction},
    Family{"deforming", "a surface that changes its shape every ten ticks", &deforming},
    Family{"moving-bodies", "bodies that move between ticks, into the ball and on it from two sides",
           &moving_bodies},
    Family{"passing-bodies", "pistons and solids that go through the ball's place between two ticks",
           &passing_bodies},
    Family{"passing-sheets", "sheets, bowls, waves and a box's side that go over the ball between two ticks",
           &passing_sheets},
};

}  // namespace

std::span<const Family> families() { return all_families; }

const Family& family_named(std::string_view name) {
  return support::item_named(name, all_families, "family");
}

}  // namespace touchmark::bench::experiments::proxy
