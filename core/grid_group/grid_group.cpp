#include "core/grid_group/grid_group.h"

#include <stdexcept>
#include <string>

#include "core/flushed_denormals.h"
#include "core/search/threads/parallel.h"

namespace touchmark {
namespace {

constexpr double min_bytes_per_triangle = 200;

void check(const GridGroup::Options& options) {
  if (!(options.cell >= 0)) {
    throw std::invalid_argument("grid-group: cell is " + std::to_string(options.cell) + ", not 0 or more");
  }
  if (!(options.bytes_per_triangle >= min_bytes_per_triangle)) {
    throw std::invalid_argument("grid-group: bytes_per_triangle is " +
                                std::to_string(options.bytes_per_triangle) + ", less than " +
                                std::to_string(min_bytes_per_triangle));
  }
  if (!options.certified && options.lookup == GridGroup::Lookup::scan) {
    throw std::invalid_argument("grid-group: certified=false is for lookup=direct, not for scan");
  }
  if (options.construction == GridGroup::Construction::lazy && options.lookup == GridGroup::Lookup::scan) {
    throw std::invalid_argument("grid-group: build=lazy is for lookup=direct, not for scan");
  }
}

/// Returns a mesh of the first triangle alone, which stands for all where all corners coincide.
TriangleMesh first_triangle(const TriangleMesh& mesh) {
  const std::vector<Vec3> corners = {mesh.corner(0, 0), mesh.corner(0, 1), mesh.corner(0, 2)};
  return {corners, {{0, 1, 2}}, {mesh.id(0)}};
}

}  // namespace

GridGroup GridGroup::build(const TriangleMesh& mesh, const Options& options) {
  check(options);
  const unsigned threads = threads_to_use(options.threads, "grid-group");
  check_flushed_denormals(mesh);
  GridGroup detector;
  detector.options_ = options;
  detector.connectivity_ = Connectivity(mesh);
  if (mesh.bounds().extent().isZero(0)) {
    detector.form_ = BruteForce::build(first_triangle(mesh));
  } else if (!FilterFrame::fits(mesh.bounds())) {
    detector.form_ = BruteForce::build(mesh);
  } else if (options.lookup == Lookup::scan) {
    detector.form_ = grid::ScanGrid::build(mesh, {options.shape, options.cell, options.groups});
  } else {
    detector.form_ =
        grid::DirectGrid::build(mesh, {options.cell, options.bytes_per_triangle, options.certified,
                                       options.construction == Construction::lazy, threads});
  }
  return detector;
}

void GridGroup::update(const TriangleMesh& mesh) {
  connectivity_.expect(mesh);
  auto* direct = std::get_if<grid::DirectGrid>(&form_);
  if (direct == nullptr || !direct->update(mesh)) *this = build(mesh, options_);
}

bool GridGroup::look_for_touch(const Probe& probe, Session& session) const noexcept {
  if (!(probe.radius >= 0)) return false;
  if (const auto* direct = std::get_if<grid::DirectGrid>(&form_)) {
    session.question = {LastQuestion::Query::touches, probe.radius};
    return direct->touches(probe, session.memory, session.work);
  }
  if (const auto* scan = std::get_if<grid::ScanGrid>(&form_)) return scan->touches(probe, session.work);
  BruteForce::Session plain;
  const bool touching = std::get_if<BruteForce>(&form_)->touches(probe, plain);
  session.work += plain.work;
  return touching;
}

std::optional<Contact> GridGroup::look_for_nearest(const Probe& probe, double reach,
                                                   Session& session) const noexcept {
  if (!(reach >= 0)) return std::nullopt;
  if (const auto* direct = std::get_if<grid::DirectGrid>(&form_)) {
    session.question = {LastQuestion::Query::nearest, reach};
    return direct->nearest(probe.center, reach, session.memory, session.work);
  }
  if (const auto* scan = std::get_if<grid::ScanGrid>(&form_))
    return scan->nearest(probe.center, reach, session.work);
  BruteForce::Session plain;
  const std::optional<Contact> contact = std::get_if<BruteForce>(&form_)->nearest(probe, reach, plain);
  session.work += plain.work;
  return contact;
}

std::optional<Impact> GridGroup::look_for_impact(const Sweep& sweep, Session& session) const noexcept {
  if (!(sweep.radius >= 0)) return std::nullopt;
  if (const auto* direct = std::get_if<grid::DirectGrid>(&form_)) {
    session.question = {LastQuestion::Query::sweep, sweep.radius};
    return direct->first_hit(sweep, session.memory, session.work);
  }
  if (const auto* scan = std::get_if<grid::ScanGrid>(&form_)) return scan->first_hit(sweep, session.work);
  BruteForce::Session plain;
  const std::optional<Impact> impact = std::get_if<BruteForce>(&form_)->first_hit(sweep, plain);
  session.work += plain.work;
  return impact;
}

std::size_t GridGroup::look_for_contacts(const Probe& probe, double reach, Session& session,
                                         std::span<Contact> into) const noexcept {
  if (!(reach >= 0)) return 0;
  if (const auto* direct = std::get_if<grid::DirectGrid>(&form_))
    return direct->contacts(probe.center, reach, session.memory, into, session.work);
  if (const auto* scan = std::get_if<grid::ScanGrid>(&form_))
    return scan->contacts(probe.center, reach, into, session.work);
  BruteForce::Session plain;
  const std::size_t count = std::get_if<BruteForce>(&form_)->contacts(probe, reach, plain, into);
  session.work += plain.work;
  return count;
}

void GridGroup::prepare(Session& session) const noexcept {
  if (const auto* direct = std::get_if<grid::DirectGrid>(&form_))
    direct->prepare(session.question, session.memory, session.work);
}

Accuracy GridGroup::accuracy() const noexcept {
  const auto* direct = std::get_if<grid::DirectGrid>(&form_);
  return direct == nullptr || direct->is_certified() ? certified : uncertified;
}

std::size_t GridGroup::bytes() const noexcept {
  if (const auto* direct = std::get_if<grid::DirectGrid>(&form_)) return direct->bytes();
  if (const auto* scan = std::get_if<grid::ScanGrid>(&form_)) return scan->bytes();
  return std::get_if<BruteForce>(&form_)->bytes();
}

std::size_t GridGroup::groups() const noexcept {
  if (const auto* direct = std::get_if<grid::DirectGrid>(&form_)) return direct->groups();
  if (const auto* scan = std::get_if<grid::ScanGrid>(&form_)) return scan->groups();
  return 1;
}

double GridGroup::cell() const noexcept {
  if (const auto* direct = std::get_if<grid::DirectGrid>(&form_)) return direct->cell();
  if (const auto* scan = std::get_if<grid::ScanGrid>(&form_)) return scan->cell();
  return 0;
}

bool GridGroup::coarsened() const noexcept {
  if (const auto* direct = std::get_if<grid::DirectGrid>(&form_)) return direct->coarsened();
  if (const auto* scan = std::get_if<grid::ScanGrid>(&form_)) return scan->coarsened();
  return false;
}

}  // namespace touchmark
