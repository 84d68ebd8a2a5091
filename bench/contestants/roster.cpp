/// The only file that knows which baselines were built: TOUCHMARK_WITH_NAME is 0 or 1.
#include "bench/contestants/roster.h"

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "baselines/reach.h"
#include "bench/contestants/roster_options.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/aabb_tree/float_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/sphere_cluster.h"

#if TOUCHMARK_WITH_BULLET
#include "baselines/bullet/bullet_detector.h"
#include "baselines/bullet/view.h"
#endif
#if TOUCHMARK_WITH_CGAL
#include "baselines/cgal/cgal_detector.h"
#endif
#if TOUCHMARK_WITH_EMBREE
#include "baselines/embree/embree_detector.h"
#include "baselines/embree/frame.h"
#endif
#if TOUCHMARK_WITH_FCL
#include "baselines/fcl/fcl_detector.h"
#endif
#if TOUCHMARK_WITH_LIBCCD
#include "baselines/libccd/libccd_detector.h"
#endif

namespace touchmark::bench::contestants {
namespace {

const Names<bool> yes_or_no{{"true", true}, {"false", false}};
const Names<bool> no_or_yes{{"false", false}, {"true", true}};

/// Every rival takes these two, see baselines/README.md.
const Names<baselines::Asking> askings{{"checked", baselines::Asking::checked},
                                       {"plain", baselines::Asking::plain}};
OptionInfo query_option() {
  return choice("query", askings,
                "checked: the mesh's box and the last contact's triangle first; plain: the rival at once");
}
baselines::Asking asking(const OptionValues& values) { return chosen(values, "query", askings); }

OptionInfo certified_option() {
  return choice("certified", yes_or_no, "false: contact as doubles have it, to measure what certainty costs");
}

ContestantInfo brute_force() {
  ContestantInfo info;
  info.name = "brute-force";
  info.summary = "every triangle, every time: both papers' \"without grouping\"";
  info.accuracy = "exact";
  info.queries = queries_of<BruteForce>();
  info.options = {side_option()};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    return contestant<BruteForce>(mesh, {}, values);
  };
  return info;
}

ContestantInfo aabb_tree() {
  static const Names<bool> precisions{{"double", false}, {"float", true}};
  const auto in_floats = [](const OptionValues& values) { return chosen(values, "precision", precisions); };
  ContestantInfo info;
  info.name = "aabb-tree";
  info.summary = "a plain binary tree of boxes: the reference";
  info.accuracy = "exact; precision=float: approximate";
  info.queries = queries_of<AabbTree>();
  info.options = {{"leaf_size", OptionKind::count, {}, "4", "triangles a leaf holds at most"},
                  choice("precision", precisions,
                         "float: mesh, boxes, kernel and distances in single precision; touches and nearest, "
                         "no side, nothing certified"),
                  certified_option(),
                  updated_option(),
                  side_option()};
  info.build = [=](const TriangleMesh& mesh, const OptionValues& values) {
    const std::size_t leaf_size = values.count("leaf_size");
    if (in_floats(values)) {
      if (asks_for_side(values)) throw std::invalid_argument("aabb-tree: precision=float tells no side");
      return contestant<FloatTree>(mesh, {leaf_size});
    }
    return contestant<AabbTree>(mesh, {leaf_size, chosen(values, "certified", yes_or_no)}, values);
  };
  info.storage_rounding = [=](const TriangleMesh& mesh,
                              const OptionValues& values) -> std::optional<StorageRounding> {
    if (!in_floats(values)) return std::nullopt;
    const FloatFrame frame = FloatFrame::around(mesh.bounds());
    return stored_in_single_precision(frame.scale, frame.origin);
  };
  return info;
}

/// Whether cells or groups are fewer than asked for, to keep within memory.
std::string remark_on(const GridGroup& detector, const GridGroup::Options& options, std::size_t triangles) {
  if (options.cell > 0 && detector.cell() > 1.01 * options.cell) {
    return fmt::format("cells of {} would take more memory than they may; the smallest is {}", options.cell,
                       detector.cell());
  }
  if (options.bytes_per_triangle != GridGroup::Options().bytes_per_triangle && detector.coarsened() &&
      options.lookup == GridGroup::Lookup::direct) {
    return fmt::format("within {} bytes a triangle {} of {} have a group, the others are searched for",
                       options.bytes_per_triangle, detector.groups(), triangles);
  }
  return "";
}

ContestantInfo grid_group() {
  static const Names<GridGroup::Lookup> lookups{{"direct", GridGroup::Lookup::direct},
                                                {"scan", GridGroup::Lookup::scan}};
  static const Names<GridGroup::Construction> makings{{"whole", GridGroup::Construction::whole},
                                                      {"lazy", GridGroup::Construction::lazy}};
  static const Names<GridGroup::Shape> shapes{{"cube", GridGroup::Shape::cube},
                                              {"sphere", GridGroup::Shape::sphere}};
  ContestantInfo info;
  info.name = "grid-group";
  info.summary = "triangles grouped by uniform cells, after Park & Jang 2018";
  info.accuracy = "exact";
  info.queries = queries_of<GridGroup>();
  info.options = {
      choice("lookup", lookups, "direct: the probe's own cell; scan: every group, as published"),
      choice("shape", shapes, "of the groups; scan only"),
      {"cell",
       OptionKind::length,
       {},
       "0",
       "edge of a cell, direct: of the smallest; larger where memory is short; 0: choose"},
      {"groups", OptionKind::count, {}, "0", "scan with cell=0: aim at so many groups; 0: choose"},
      {"bytes_per_triangle", OptionKind::number, {}, "400", "direct: what the structure may take"},
      certified_option(),
      choice("build", makings, "lazy: groups and cells are made by the first queries that want them"),
      updated_option(),
      side_option()};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    GridGroup::Options options;
    options.lookup = chosen(values, "lookup", lookups);
    options.shape = chosen(values, "shape", shapes);
    options.cell = values.length("cell", mesh);
    options.groups = values.count("groups");
    options.bytes_per_triangle = values.number("bytes_per_triangle");
    options.certified = chosen(values, "certified", yes_or_no);
    options.construction = chosen(values, "build", makings);
    return contestant<GridGroup>(mesh, options, values, [&](const GridGroup& detector) {
      return remark_on(detector, options, mesh.size());
    });
  };
  info.bytes_per_triangle = [](const OptionValues& values) {
    return values.text("lookup") == "direct" ? values.number("bytes_per_triangle")
                                             : support::min_bytes_per_triangle;
  };
  return info;
}

ContestantInfo sphere_cluster() {
  static const Names<SphereCluster::Lookup> lookups{{"tree", SphereCluster::Lookup::tree},
                                                    {"scan", SphereCluster::Lookup::scan}};
  static const Names<Simd> widths{
      {"avx512", Simd::avx512}, {"avx2", Simd::avx2}, {"portable", Simd::portable}};
  static const Names<SphereCluster::Construction> makings{{"whole", SphereCluster::Construction::whole},
                                                          {"lazy", SphereCluster::Construction::lazy}};
  ContestantInfo info;
  info.name = "sphere-cluster";
  info.summary = "triangles in clustered bounding spheres, after Choi & Sung 2017";
  info.accuracy = "exact; precise=false: conservative";
  info.queries = queries_of<SphereCluster>();
  info.options = {
      choice("lookup", lookups, "tree: a hierarchy, nearest first; scan: every sphere, as published"),
      {"clustering",
       OptionKind::length,
       {},
       "0",
       "distance between centroids that share a sphere; 0: a sphere each"},
      choice("precise", yes_or_no, "false: the published fast level alone, spheres for triangles"),
      certified_option(),
      choice("build", makings,
             "tree; lazy: distances all around are sampled by the first queries that want them"),
      choice("prepare", no_or_yes,
             "true: list triangles for the next step in the idle rest of a tick, clocked apart"),
      choice("simd", widths, "tree: no wider instructions than these, nor than the processor's"),
      updated_option(),
      side_option()};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    SphereCluster::Options options;
    options.lookup = chosen(values, "lookup", lookups);
    options.clustering = values.length("clustering", mesh);
    options.precise = chosen(values, "precise", yes_or_no);
    options.certified = chosen(values, "certified", yes_or_no);
    options.widest = chosen(values, "simd", widths);
    options.construction = chosen(values, "build", makings);
    return chosen(values, "prepare", no_or_yes)
               ? contestant<SphereCluster, Prefetch::on>(mesh, options, values)
               : contestant<SphereCluster>(mesh, options, values);
  };
  return info;
}

ContestantInfo fcl() {
  ContestantInfo info;
  info.name = "fcl";
  info.summary = "Flexible Collision Library: bounding volume hierarchies";
#if TOUCHMARK_WITH_FCL
  using baselines::FclDetector;
  using Volume = FclDetector::Volume;
  using Method = FclDetector::Method;
  using Narrow = FclDetector::Narrow;
  static const Names<Volume> volumes{{"kios", Volume::kios},
                                     {"obbrss", Volume::obbrss},
                                     {"obb", Volume::obb},
                                     {"rss", Volume::rss},
                                     {"aabb", Volume::aabb}};
  static const Names<Method> methods{
      {"collide", Method::collide}, {"traverse", Method::traverse}, {"distance", Method::distance}};
  static const Names<Narrow> narrows{{"fcl", Narrow::fcl}, {"exact", Narrow::exact}};
  info.accuracy = "approximate; bv=aabb with narrow=exact: exact";
  info.queries = queries_of<FclDetector>();
  info.options = {
      choice("bv", volumes, "the hierarchy's bounding volume"),
      choice("method", methods, "collide: as most programs use it; distance: best first, bounded"),
      choice("narrow", narrows, "exact: this project's kernel on the triangles FCL reaches"), query_option()};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    return contestant<FclDetector>(mesh, {chosen(values, "bv", volumes), chosen(values, "method", methods),
                                          chosen(values, "narrow", narrows), asking(values)});
  };
#endif
  return info;
}

ContestantInfo bullet() {
  ContestantInfo info;
  info.name = "bullet";
  info.summary = "Bullet Physics: a hierarchy of quantised boxes";
#if TOUCHMARK_WITH_BULLET
  using baselines::BulletDetector;
  using Precision = BulletDetector::Precision;
  using Method = BulletDetector::Method;
  using Frame = BulletDetector::Frame;
  static const Names<Precision> precisions{{"double", Precision::double_precision},
                                           {"float", Precision::single_precision}};
  static const Names<Method> methods{{"contact", Method::contact}, {"callback", Method::callback}};
  static const Names<Frame> frames{{"mesh", Frame::mesh}, {"fitted", Frame::fitted}};
  info.accuracy = "approximate; method=callback: exact";
  info.queries = queries_of<BulletDetector>();
  info.options = {
      choice("precision", precisions, "which of Debian's two builds of the library"),
      choice("method", methods, "contact: as most programs use it; callback: this project's kernel"),
      choice("frame", frames, "fitted: moved and scaled to the size that Bullet is written for"),
      query_option()};
  // The two builds define the same names, so a program has one or the other.
  info.worker_program = [](const OptionValues& values) {
    return values.text("precision") == "float" ? "touchmark-worker-bullet-float" : default_worker_program;
  };
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    if (chosen(values, "precision", precisions) != BulletDetector::precision()) {
      throw std::invalid_argument("bullet: precision=" + values.text("precision") +
                                  " is not the build of Bullet that this program has");
    }
    return contestant<BulletDetector>(
        mesh, {chosen(values, "method", methods), chosen(values, "frame", frames), asking(values)});
  };
  info.storage_rounding = [](const TriangleMesh& mesh,
                             const OptionValues& values) -> std::optional<StorageRounding> {
    if (values.text("precision") != "float" || values.text("method") != "contact") return std::nullopt;
    baselines::BulletView view;
    if (chosen(values, "frame", frames) == Frame::fitted) view = baselines::BulletView::fitted(mesh);
    return stored_in_single_precision(view.scale, view.origin);
  };
#endif
  return info;
}

ContestantInfo libccd() {
  ContestantInfo info;
  info.name = "libccd+aabb";
  info.summary = "libccd between the ball and each candidate triangle of this project's box tree";
#if TOUCHMARK_WITH_LIBCCD
  using baselines::LibccdDetector;
  using Algorithm = LibccdDetector::Algorithm;
  using Frame = LibccdDetector::Frame;
  static const Names<Algorithm> algorithms{{"gjk", Algorithm::gjk}, {"mpr", Algorithm::mpr}};
  static const Names<Frame> frames{{"fitted", Frame::fitted}, {"mesh", Frame::mesh}};
  info.accuracy = "approximate";
  info.queries = queries_of<LibccdDetector>();
  info.options = {choice("algorithm", algorithms, "gjk: GJK and EPA; mpr: Minkowski portal refinement"),
                  choice("frame", frames, "fitted: the ball as the unit ball; mesh: coordinates as they are"),
                  {"tolerance", OptionKind::number, {}, "1e-4", "of EPA and MPR; in radii when fitted"},
                  {"iterations", OptionKind::count, {}, "500", "of GJK at most"},
                  query_option()};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    return contestant<LibccdDetector>(
        mesh, {chosen(values, "algorithm", algorithms), chosen(values, "frame", frames),
               values.number("tolerance"), values.count("iterations"), asking(values)});
  };
#endif
  return info;
}

ContestantInfo embree() {
  ContestantInfo info;
  info.name = "embree";
  info.summary = "Embree: point query over its hierarchy, this project's kernel as the callback";
#if TOUCHMARK_WITH_EMBREE
  using baselines::EmbreeDetector;
  using Geometry = EmbreeDetector::Geometry;
  using Quality = EmbreeDetector::Quality;
  static const Names<Geometry> geometries{{"user", Geometry::user},
                                          {"triangle", Geometry::triangle},
                                          {"triangle_exact", Geometry::triangle_exact}};
  static const Names<Quality> qualities{
      {"medium", Quality::medium}, {"high", Quality::high}, {"refit", Quality::refit}};
  info.accuracy = "exact; geometry=triangle: approximate";
  info.queries = queries_of<EmbreeDetector>();
  info.options = {
      choice(
          "geometry", geometries,
          "user: boxes of our own, rounded outward; triangle: Embree's triangles and their closest points in "
          "single precision; triangle_exact: Embree's boxes, this project's kernel"),
      choice("quality", qualities,
             "Embree's; refit: updates refit the hierarchy instead of building it anew"),
      choice("warm", yes_or_no, "start from the distance of the session's last triangle"), query_option()};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    return contestant<EmbreeDetector>(
        mesh, {chosen(values, "geometry", geometries), chosen(values, "quality", qualities),
               chosen(values, "warm", yes_or_no), asking(values)});
  };
  info.storage_rounding = [](const TriangleMesh& mesh,
                             const OptionValues& values) -> std::optional<StorageRounding> {
    if (chosen(values, "geometry", geometries) != Geometry::triangle) return std::nullopt;
    const baselines::EmbreeFrame frame(mesh.bounds());
    return stored_in_single_precision(frame.scale, frame.origin);
  };
#endif
  return info;
}

ContestantInfo cgal() {
  ContestantInfo info;
  info.name = "cgal";
  info.summary = "CGAL: closest point over its AABB tree";
#if TOUCHMARK_WITH_CGAL
  using baselines::CgalDetector;
  using Kernel = CgalDetector::Kernel;
  using Hint = CgalDetector::Hint;
  static const Names<Kernel> kernels{
      {"epick", Kernel::epick}, {"simple", Kernel::simple}, {"epeck", Kernel::epeck}};
  static const Names<Hint> hints{{"bounded", Hint::bounded}, {"none", Hint::none}, {"last", Hint::last}};
  info.accuracy = "approximate; kernel=epeck: exact";
  info.queries = queries_of<CgalDetector>();
  info.options = {choice("kernel", kernels,
                         "simple: doubles throughout; epick: exact predicates; epeck: exact points, too"),
                  choice("hint", hints,
                         "where a search starts: none: CGAL's own; last: at the last triangle; bounded: that "
                         "within the reach"),
                  query_option()};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    return contestant<CgalDetector>(
        mesh, {chosen(values, "kernel", kernels), chosen(values, "hint", hints), asking(values)});
  };
#endif
  return info;
}

// Each rival in the form most programs use and in its best fair one; see baselines/NAME/README.md.
const std::vector<std::string> compared_by_default{"brute-force",
                                                   "aabb-tree",
                                                   "grid-group:lookup=scan",
                                                   "grid-group:lookup=scan,shape=sphere",
                                                   "grid-group",
                                                   "sphere-cluster:lookup=scan",
                                                   "sphere-cluster:lookup=scan,precise=false",
                                                   "sphere-cluster",
                                                   "fcl",
                                                   "fcl:bv=obbrss",
                                                   "fcl:bv=aabb,method=distance,narrow=exact",
                                                   "bullet",
                                                   "bullet:precision=float",
                                                   "bullet:precision=float,frame=fitted",
                                                   "bullet:method=callback,frame=fitted",
                                                   "libccd+aabb",
                                                   "libccd+aabb:algorithm=mpr",
                                                   "embree",
                                                   "embree:query=plain",
                                                   "embree:geometry=triangle",
                                                   "cgal:kernel=simple,hint=bounded"};

// What verify runs besides: every other exact form, and the rivals' forms that answer differently.
const std::vector<std::string> verified_besides{"aabb-tree:precision=float",
                                                "aabb-tree:updated=true",
                                                "grid-group:cell=1%",
                                                "grid-group:build=lazy",
                                                "grid-group:updated=true",
                                                "grid-group:build=lazy,updated=true",
                                                "sphere-cluster:clustering=2%",
                                                "sphere-cluster:build=lazy",
                                                "sphere-cluster:prepare=true",
                                                "sphere-cluster:updated=true",
                                                "sphere-cluster:build=lazy,updated=true",
                                                "sphere-cluster:lookup=scan,clustering=2%",
                                                "sphere-cluster:lookup=scan,clustering=2%,precise=false",
                                                "fcl:bv=obb",
                                                "fcl:bv=rss,method=distance",
                                                "fcl:bv=kios,method=traverse,narrow=exact",
                                                "bullet:frame=fitted",
                                                "bullet:precision=float,method=callback",
                                                "embree:geometry=triangle_exact",
                                                "embree:geometry=triangle,query=plain",
                                                "cgal",
                                                "cgal:hint=none,query=plain",
                                                "cgal:kernel=epeck,hint=bounded"};

// Each contestant over what trades its accuracy for its time.
const std::vector<std::string> over_accuracy{"aabb-tree",
                                             "aabb-tree:certified=false",
                                             "aabb-tree:precision=float",
                                             "grid-group",
                                             "grid-group:certified=false",
                                             "grid-group:cell=0.5%",
                                             "grid-group:cell=4%",
                                             "sphere-cluster",
                                             "sphere-cluster:certified=false",
                                             "sphere-cluster:clustering=2%",
                                             "sphere-cluster:precise=false",
                                             "sphere-cluster:clustering=0.5%,precise=false",
                                             "sphere-cluster:clustering=1%,precise=false",
                                             "sphere-cluster:clustering=2%,precise=false",
                                             "sphere-cluster:clustering=5%,precise=false",
                                             "fcl",
                                             "fcl:bv=kios,method=traverse,narrow=exact",
                                             "fcl:bv=rss,method=distance",
                                             "fcl:bv=aabb,method=distance,narrow=exact",
                                             "bullet",
                                             "bullet:frame=fitted",
                                             "bullet:precision=float",
                                             "bullet:precision=float,frame=fitted",
                                             "bullet:method=callback,frame=fitted",
                                             "libccd+aabb:tolerance=1e-2",
                                             "libccd+aabb",
                                             "libccd+aabb:tolerance=1e-8",
                                             "libccd+aabb:tolerance=1e-8,iterations=20",
                                             "libccd+aabb:iterations=5",
                                             "libccd+aabb:algorithm=mpr,tolerance=1e-2",
                                             "libccd+aabb:algorithm=mpr",
                                             "libccd+aabb:algorithm=mpr,tolerance=1e-8",
                                             "embree",
                                             "embree:geometry=triangle",
                                             "cgal:kernel=simple,hint=bounded",
                                             "cgal:kernel=epeck,hint=bounded"};

}  // namespace

const Roster& roster() {
  static const Roster all({brute_force(), aabb_tree(), grid_group(), sphere_cluster(), fcl(), bullet(),
                           libccd(), embree(), cgal()},
                          compared_by_default, verified_besides, over_accuracy);
  return all;
}

}  // namespace touchmark::bench::contestants
