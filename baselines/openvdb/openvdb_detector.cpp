#include "baselines/openvdb/openvdb_detector.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <openvdb/math/Stencils.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <tbb/task_arena.h>

#include "core/geometry/point_triangle.h"
#include "core/triangle_ids.h"
#include "core/triangle_mesh.h"

// The library holds these two compiled.
extern template class openvdb::tree::Tree<openvdb::Int32Tree::RootNodeType>;
extern template class openvdb::Grid<openvdb::Int32Tree>;

namespace touchmark::baselines {
namespace {

/// How the space about a mesh is divided.
struct Division {
  Aabb bounds;
  Vec3 origin;
  double voxel;
  double voxels_per_length;
  double band;  ///< voxels: distances are told up to this
};

/// At its edge the narrow band is cut off, and what is interpolated there reads cells of which a corner is as
/// far outside as the diagonal of a cell is long.
constexpr double beyond_band = 2;

/// Voxels along the mesh at most: places are given in single precision, which tells 2^10 of them apart in a
/// voxel there.
constexpr double max_along = 0x1p14;

openvdb::Vec3f single(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

void require_length(const char* name, double length) {
  if (!(length > 0 && std::isfinite(length)))
    throw std::invalid_argument(std::string("openvdb: ") + name + " is " + std::to_string(length) +
                                " mesh units, not a number above 0");
}

/// The mesh in voxels from the middle of its box. In this form the library has its converter compiled.
struct MeshInVoxels {
  MeshInVoxels(const TriangleMesh& mesh, const Division& division) {
    for (const Vec3& vertex : mesh.vertices())
      points.push_back(single((vertex - division.origin) * division.voxels_per_length));
    for (const TriangleMesh::Corners& c : mesh.triangles()) triangles.emplace_back(c[0], c[1], c[2]);
  }

  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
};

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const Vec3 a = mesh.corner(i, 0);
    sum += 0.5 * (mesh.corner(i, 1) - a).cross(mesh.corner(i, 2) - a).norm();
  }
  return sum;
}

Division divided(const TriangleMesh& mesh, const OpenVdbDetector::Options& options) {
  constexpr double default_share = 0.01;  // of the diagonal
  const Aabb bounds = mesh.bounds();
  const auto chosen = [&](double length) { return length == 0 ? default_share * mesh.diagonal() : length; };
  const double voxel = chosen(options.voxel), band = chosen(options.band);
  require_length("voxel", voxel);
  require_length("band", band);
  require_length("the number of voxels in a length of 1", 1 / voxel);
  const double in_band = band / voxel;
  // The library's own band is three voxels.
  const Division division{bounds, bounds.center(), voxel, 1 / voxel,
                          std::max<double>(openvdb::LEVEL_SET_HALF_WIDTH, in_band)};

  constexpr double max_bytes = 0x1p32;
  const Vec3 along = bounds.extent() / voxel + Vec3::Constant(2 * (division.band + beyond_band));
  const double in_box = along.prod(),
               about_surface = 2 * (division.band + beyond_band) * (area(mesh) / voxel) / voxel;
  const double bytes = sizeof(float) * std::min(in_box, about_surface);
  if (!(along.maxCoeff() <= max_along) || !(bytes <= max_bytes))
    throw std::invalid_argument("openvdb: voxel is " + std::to_string(voxel) + " mesh units, so small that " +
                                std::to_string(along.maxCoeff()) + " of them lie along the mesh and take " +
                                std::to_string(bytes / 0x1p30) + " GiB; at most are 16384, and 4 GiB");
  return division;
}

/// Tells detectors apart, so that a session knows whose voxels it holds.
std::uint64_t next_number() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

}  // namespace

struct OpenVdbDetector::Model {
  Model(const TriangleMesh& mesh, const Options& chosen) : options(chosen), division(divided(mesh, chosen)) {
    [[maybe_unused]] static const bool started = (openvdb::initialize(), true);
    const bool keeps_polygons = options.contact == Found::polygon;
    if (keeps_polygons) {
      polygons = openvdb::Int32Grid::create(-1);
      triangles = prepare(mesh);
      ids = mesh.triangle_ids();
    }
    // One thread, as everybody else builds with; and with several, polygons that are as near come either way.
    tbb::task_arena alone(1);
    alone.execute([&] {
      const auto transform = openvdb::math::Transform::createLinearTransform(1);
      const auto half_width = static_cast<float>(division.band + beyond_band);
      const int flags = options.distances == Distances::without ? openvdb::tools::UNSIGNED_DISTANCE_FIELD : 0;
      const MeshInVoxels given(mesh, division);
      openvdb::util::NullInterrupter never;
      distances = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
          never,
          openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I>(given.points,
                                                                                     given.triangles),
          *transform, half_width, half_width, flags, polygons.get());
    });
    if (keeps_polygons) distances.reset();
    bytes = (keeps_polygons ? polygons->memUsage() : distances->memUsage()) +
            triangles.capacity() * sizeof(PreparedTriangle) + ids.bytes();
  }

  Options options;
  Division division;
  openvdb::FloatGrid::Ptr distances;  ///< null where polygons are measured
  openvdb::Int32Grid::Ptr polygons;   ///< null where they are not
  std::vector<PreparedTriangle> triangles;
  TriangleIds ids;
  std::size_t bytes = 0;
  std::uint64_t number = next_number();
};

/// What one thread reads the grids by: the cell and the path to the voxel that were read last are kept.
struct OpenVdbDetector::State {
  explicit State(const Model& model) : number(model.number) {
    if (model.distances) cell.emplace(*model.distances);
    if (model.polygons) voxel.emplace(model.polygons->tree());
  }

  /// Returns the distance in voxels, with its sign, and moves the cell there.
  float distance_at(const openvdb::Vec3f& place) {
    cell->moveTo(place);
    return cell->interpolation(place);
  }
  /// Returns the direction from the surface to a place in the cell that was read last.
  Vec3 direction_at(const openvdb::Vec3f& place, bool inside) const {
    const openvdb::Vec3f gradient = cell->gradient(place);
    const Vec3 uphill(gradient.x(), gradient.y(), gradient.z());
    const double steepness = uphill.norm();
    if (!(steepness > 0)) return Vec3::UnitZ();  // between two surfaces, or on an open one
    return (inside ? -1 : 1) / steepness * uphill;
  }

  std::uint64_t number;  ///< The number of the detector whose grids these are.
  std::optional<openvdb::math::BoxStencil<openvdb::FloatGrid, false>> cell;
  std::optional<openvdb::Int32Grid::ConstUnsafeAccessor> voxel;
};

OpenVdbDetector OpenVdbDetector::build(const TriangleMesh& mesh, const Options& options) {
  if (mesh.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw MeshError("openvdb: a mesh of " + std::to_string(mesh.size()) +
                    " triangles has more of them than OpenVDB can count");
  return OpenVdbDetector(make_hidden<Model>(mesh, options));
}

OpenVdbDetector::State& OpenVdbDetector::state(Session& session) const {
  if (!session.state || session.state->number != model_->number) session.state = make_hidden<State>(*model_);
  return *session.state;
}

/// Returns the place in voxels, or nothing where nothing is to be found.
std::optional<Vec3> OpenVdbDetector::place_within(const Vec3& center, double reach) const noexcept {
  const Division& division = model_->division;
  if (!answerable(center, reach)) return std::nullopt;
  const double known = division.band * division.voxel;
  const double farthest = model_->options.query == Asking::checked ? std::min(reach, known) : known;
  if (out_of_reach(division.bounds, center, farthest)) return std::nullopt;
  return Vec3((center - division.origin) * division.voxels_per_length);
}

/// Returns the distance that is interpolated, with its sign and in voxels, or nothing beyond the band.
std::optional<float> OpenVdbDetector::distance_at(const Vec3& place, Session& session) const noexcept {
  ++session.work.cells;
  const float distance = state(session).distance_at(single(place));
  if (!(std::abs(distance) <= model_->division.band)) return std::nullopt;
  return distance;
}

/// Returns the polygon that the voxel about the place keeps, or null.
const PreparedTriangle* OpenVdbDetector::polygon_at(const Vec3& place, Session& session) const noexcept {
  ++session.work.cells;
  const openvdb::Coord voxel = openvdb::Coord::round(openvdb::Vec3d(place.x(), place.y(), place.z()));
  const std::int32_t polygon = state(session).voxel->getValue(voxel);
  if (polygon < 0) return nullptr;
  ++session.work.triangles;
  return &model_->triangles[static_cast<std::size_t>(polygon)];
}

bool OpenVdbDetector::touches(const Probe& probe, Session& session) const noexcept {
  const Division& division = model_->division;
  const std::optional<Vec3> place = place_within(probe.center, probe.radius);
  if (!place) return false;
  const double radius = std::min(probe.radius, division.band * division.voxel);
  if (model_->polygons) {
    const PreparedTriangle* polygon = polygon_at(*place, session);
    return polygon != nullptr && std::sqrt(squared_distance(*polygon, probe.center)) <= radius;
  }
  const std::optional<float> distance = distance_at(*place, session);
  return distance && std::abs(*distance) * division.voxel <= radius;
}

std::optional<Contact> OpenVdbDetector::nearest(const Probe& probe, double reach,
                                                Session& session) const noexcept {
  const Division& division = model_->division;
  const std::optional<Vec3> place = place_within(probe.center, reach);
  if (!place) return std::nullopt;
  reach = std::min(reach, division.band * division.voxel);
  if (model_->polygons) {
    const PreparedTriangle* polygon = polygon_at(*place, session);
    if (polygon == nullptr) return std::nullopt;
    const Contact contact = contact_on(*polygon, probe.center, model_->ids[polygon->index]);
    if (!(contact.distance <= reach)) return std::nullopt;
    return contact;
  }
  const std::optional<float> found = distance_at(*place, session);
  if (!found) return std::nullopt;
  const double distance = std::abs(*found) * division.voxel;
  if (!(distance <= reach)) return std::nullopt;
  const Vec3 away = session.state->direction_at(single(*place), *found < 0);
  return Contact{probe.center - distance * away, away, distance, no_triangle};
}

std::size_t OpenVdbDetector::bytes() const noexcept { return model_->bytes; }

Accuracy OpenVdbDetector::accuracy() const noexcept {
  // A distance changes by no more than the way. In a cell the corners' ways, weighted as in the
  // interpolation, are sqrt(3)/2 voxels at most, in its middle. The nearest voxel is no farther than that,
  // and its polygon is farther than the nearest by that way at most, there and back.
  const double voxels = model_->polygons ? std::sqrt(3) : std::sqrt(3) / 2;
  // Places and distances in single precision, within as many voxels as may lie along the mesh.
  constexpr double rounding = 8 * 0x1p-24 * max_along;
  return {Guarantee::approximate, 0, (voxels + rounding) * model_->division.voxel};
}

}  // namespace touchmark::baselines
