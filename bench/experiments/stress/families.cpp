#include <array>

#include "bench/experiments/stress/family.h"
#include "bench/experiments/stress/makers.h"
#include "bench/support/did_you_mean.h"

namespace touchmark::bench::experiments::stress {
namespace {

constexpr bool at_the_edge = true;  // of contact: Family::adversarial

// One line a family.
constexpr std::array list{
    Family{"thresholds", "ordinary meshes, each radius at the exact distance or one ulp to a side of it",
           at_the_edge, &stress::thresholds},
    Family{"radius-zero", "a point exactly on a face, an edge or a vertex, or one ulp off it", at_the_edge,
           &stress::radius_zero},
    Family{"tangent", "balls that touch a face, an edge or a vertex in exactly one point, to the last bit",
           at_the_edge, &stress::tangent},
    Family{"ties",
           "centres exactly as far from two or more triangles: of cubes, mirror images, doubled faces",
           at_the_edge, &stress::ties},
    Family{"ball-centre", "the middle of a ball and its surroundings: every triangle is nearly nearest",
           at_the_edge, &stress::ball_centre},
    Family{"cell-borders", "centres on the borders of the grids one could lay over the mesh, and one ulp off",
           at_the_edge, &stress::cell_borders},
    Family{"one-cell", "all triangles but two so close together that they share a cell", at_the_edge,
           &stress::one_cell},
    Family{"spanning-triangle", "one triangle across the whole of a mesh of small ones", at_the_edge,
           &stress::spanning_triangle},
    Family{"single-triangle", "meshes of one triangle", at_the_edge, &stress::single_triangle},
    Family{"needles", "one side far shorter than the others, aspect ratios to 1e15", at_the_edge,
           &stress::needles},
    Family{"caps", "a corner all but on the side opposite, aspect ratios to 1e15", at_the_edge,
           &stress::caps},
    Family{"degenerate", "points, segments and collinear corners among good triangles", at_the_edge,
           &stress::degenerate},
    Family{"scales", "meshes of every size from 1e-300 to 1e300", at_the_edge, &stress::scales},
    Family{"offsets", "meshes at up to 2^50 times their size from the origin", at_the_edge, &stress::offsets},
    Family{"huge", "probes as far away and as large as doubles go, infinite radius and reach", false,
           &stress::huge},
    Family{"denormal", "centres, radii and a whole mesh of numbers too small for all their digits", false,
           &stress::denormal},
    Family{"not-a-number", "NaN and infinity in centres, radii and reaches, and negative radii", false,
           &stress::not_a_number},
    Family{"empty-mesh", "a mesh without a triangle, which is to be refused", false, &stress::empty_mesh},
    Family{"sweeps",
           "ways that graze, begin an ulp beside the surface, lie in a triangle's plane or lead nowhere",
           false, &stress::sweeps},
    Family{"far-sweeps", "the same at up to 2^50 times the mesh's size from the origin, and at any scale",
           false, &stress::far_sweeps},
    Family{"motions", "every trajectory of the comparison on ordinary and thin meshes", false,
           &stress::motions},
    Family{"ordinary", "balls of every size anywhere about small meshes, other ones with each seed", false,
           &stress::control_family},
    Family{"near-ties",
           "two or more triangles as far but for rounding: turned images, and where the nearest changes",
           false, &stress::near_ties},
    Family{"shared-features",
           "hundreds of triangles as near by one corner, edge or face, or each by a place of its own", false,
           &stress::shared_features},
};

}  // namespace

std::span<const Family> families() { return list; }

const Family& family_named(std::string_view name) { return support::item_named(name, list, "family"); }

}  // namespace touchmark::bench::experiments::stress
