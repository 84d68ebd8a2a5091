#include "core/grid_group/grid_group.h"

#include <stdexcept>
#include <string>

#include "core/flushed_denormals.h"
#include "core/grid_group/build_input.h"
#include "core/search/threads/parallel.h"

namespace touchmark {

void GridGroup::check(const Options& options) {
  constexpr double min_bytes_per_triangle = 200;
  grid::check_cell(options.cell);
  if (!(options.bytes_per_triangle >= min_bytes_per_triangle)) {
    throw std::invalid_argument("grid-group: bytes_per_triangle is " +
                                std::to_string(options.bytes_per_triangle) + ", less than " +
                                std::to_string(min_bytes_per_triangle));
  }
  threads_to_use(options.threads, "grid-group");
}

GridGroup GridGroup::build(const TriangleMesh& mesh, const Options& options) {
  check(options);
  check_flushed_denormals(mesh);
  GridGroup detector;
  detector.options_ = options;
  detector.connectivity_ = Connectivity(mesh);
  if (mesh.bounds().extent().isZero(0)) {
    detector.form_ = BruteForce::build(grid::first_triangle(mesh));
  } else if (!FilterFrame::fits(mesh.bounds())) {
    detector.form_ = BruteForce::build(mesh);
  } else {
    detector.form_ = grid::DirectGrid::build(
        mesh, {options.cell, options.bytes_per_triangle, options.certified,
               options.construction == Construction::lazy, threads_to_use(options.threads, "grid-group")});
  }
  return detector;
}

void GridGroup::update(const TriangleMesh& mesh) {
  connectivity_.expect(mesh);
  auto* grid = std::get_if<grid::DirectGrid>(&form_);
  if (grid == nullptr || !grid->update(mesh)) *this = build(mesh, options_);
}

bool GridGroup::look_for_touch(const Probe& probe, Session& session) const noexcept {
  if (!(probe.radius >= 0)) return false;
  if (direct() == nullptr) return brute_force().touches(probe, session);
  session.question = {LastQuestion::Query::touches, probe.radius};
  return direct()->touches(probe, session.memory, session.work);
}

std::optional<Contact> GridGroup::look_for_nearest(const Probe& probe, double reach,
                                                   Session& session) const noexcept {
  if (!(reach >= 0)) return std::nullopt;
  if (direct() == nullptr) return brute_force().nearest(probe, reach, session);
  session.question = {LastQuestion::Query::nearest, reach};
  return direct()->nearest(probe.center, reach, session.memory, session.work);
}

std::optional<Impact> GridGroup::look_for_impact(const Sweep& sweep, Session& session) const noexcept {
  if (!(sweep.radius >= 0)) return std::nullopt;
  if (direct() == nullptr) return brute_force().first_hit(sweep, session);
  session.question = {LastQuestion::Query::sweep, sweep.radius};
  return direct()->first_hit(sweep, session.memory, session.work);
}

std::size_t GridGroup::look_for_contacts(const Probe& probe, double reach, Session& session,
                                         std::span<Contact> into) const noexcept {
  if (!(reach >= 0)) return 0;
  if (direct() == nullptr) return brute_force().contacts(probe, reach, session, into);
  return direct()->contacts(probe.center, reach, session.memory, into, session.work);
}

void GridGroup::prepare(Session& session) const noexcept {
  if (direct() != nullptr) direct()->prepare(session.question, session.memory, session.work);
}

Accuracy GridGroup::accuracy() const noexcept {
  return direct() == nullptr || direct()->is_certified() ? certified : uncertified;
}

std::size_t GridGroup::bytes() const noexcept {
  return direct() == nullptr ? brute_force().bytes() : direct()->bytes();
}

}  // namespace touchmark
