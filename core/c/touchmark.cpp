#include "core/c/touchmark.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/c/handles.h"
#include "core/named/named_detector.h"
#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark::c {
namespace {

/// Longer texts are cut off. A fixed place, so that telling of an error cannot fail.
thread_local std::array<char, 1024> last_error{};

}  // namespace

int fail(std::string_view message) noexcept {
  const std::size_t length = std::min(message.size(), last_error.size() - 1);
  std::copy_n(message.data(), length, last_error.data());
  last_error[length] = '\0';
  return TOUCHMARK_ERROR;
}

int fail_for_null(const char* function, const char* argument) noexcept {
  std::array<char, 128> message{};
  std::snprintf(message.data(), message.size(), "%s: %s is NULL", function, argument);
  return fail(message.data());
}

int fail_for_size(const char* function, const char* argument, double value) noexcept {
  std::array<char, 192> message{};
  std::snprintf(message.data(), message.size(), "%s: %s is %g; it must be 0 or more", function, argument,
                value);
  return fail(message.data());
}

bool refuses(const char* function, const void* session, const double* center, const char* center_name,
             const char* size_name, double size) noexcept {
  if (session == nullptr) {
    fail_for_null(function, "session");
  } else if (center == nullptr) {
    fail_for_null(function, center_name);
  } else if (!(size >= 0)) {
    fail_for_size(function, size_name, size);
  } else {
    return false;
  }
  return true;
}

namespace {

void expect_count(const char* what, std::size_t count) {
  if (count <= std::numeric_limits<std::uint32_t>::max()) return;
  throw std::invalid_argument(std::to_string(count) + " " + what + "; there can be 4294967295 at most");
}

/// Also refuses a detector that cannot be asked any more.
bool refuses_query(const char* function, const touchmark_session* session, const double* center,
                   const char* center_name, const char* size_name, double size) noexcept {
  if (refuses(function, session, center, center_name, size_name, size)) return true;
  if (session->held->usable) return false;
  fail(unusable);
  return true;
}

}  // namespace
}  // namespace touchmark::c

using namespace touchmark::c;
using touchmark::NamedDetector;
using touchmark::TriangleMesh;
using touchmark::Vec3;

const char* touchmark_version(void) { return TOUCHMARK_VERSION; }

const char* touchmark_last_error(void) { return touchmark::c::last_error.data(); }

touchmark_mesh* touchmark_mesh_create(const double* vertices, size_t vertex_count, const uint32_t* triangles,
                                      size_t triangle_count) {
  touchmark_mesh* const none = nullptr;
  if (vertices == nullptr) return fail_for_null(__func__, "vertices"), none;
  if (triangles == nullptr) return fail_for_null(__func__, "triangles"), none;
  return guarded(__func__, none, [&] {
    expect_count("vertices", vertex_count);
    expect_count("triangles", triangle_count);
    std::vector<Vec3> points(vertex_count);
    for (std::size_t i = 0; i < vertex_count; ++i) points[i] = point(vertices + 3 * i);
    std::vector<TriangleMesh::Corners> corners(triangle_count);
    for (std::size_t i = 0; i < triangle_count; ++i)
      corners[i] = {triangles[3 * i], triangles[3 * i + 1], triangles[3 * i + 2]};
    return new touchmark_mesh{std::make_shared<TriangleMesh>(std::move(points), std::move(corners))};
  });
}

void touchmark_mesh_free(touchmark_mesh* mesh) { delete mesh; }

int touchmark_mesh_bounds(const touchmark_mesh* mesh, double min[3], double max[3]) {
  if (mesh == nullptr) return fail_for_null(__func__, "mesh");
  if (min == nullptr) return fail_for_null(__func__, "min");
  if (max == nullptr) return fail_for_null(__func__, "max");
  store(mesh->mesh->bounds().min, min);
  store(mesh->mesh->bounds().max, max);
  return TOUCHMARK_YES;
}

touchmark_detector* touchmark_detector_build(const touchmark_mesh* mesh, const char* text) {
  touchmark_detector* const none = nullptr;
  if (mesh == nullptr) return fail_for_null(__func__, "mesh"), none;
  return guarded(__func__, none, [&] {
    auto held = std::make_shared<Held>();
    held->detector = NamedDetector::build(*mesh->mesh, text == nullptr ? "sphere-cluster" : text);
    held->mesh = mesh->mesh;
    return new touchmark_detector{std::move(held)};
  });
}

void touchmark_detector_free(touchmark_detector* detector) { delete detector; }

size_t touchmark_detector_bytes(const touchmark_detector* detector) {
  return detector == nullptr || !detector->held->usable ? 0 : detector->held->detector->bytes();
}

int touchmark_detector_update(touchmark_detector* detector, const touchmark_mesh* mesh) {
  if (detector == nullptr) return fail_for_null(__func__, "detector");
  if (mesh == nullptr) return fail_for_null(__func__, "mesh");
  Held& held = *detector->held;
  if (!held.usable) return fail(unusable);
  return guarded(__func__, int{TOUCHMARK_ERROR}, [&] {
    held.usable = false;
    try {
      held.detector->update(*mesh->mesh);
    } catch (const std::invalid_argument&) {
      held.usable = true;
      throw;
    }
    held.mesh = mesh->mesh;
    ++held.updates;
    held.usable = true;
    return int{TOUCHMARK_YES};
  });
}

touchmark_session* touchmark_session_create(const touchmark_detector* detector) {
  touchmark_session* const none = nullptr;
  if (detector == nullptr) return fail_for_null(__func__, "detector"), none;
  if (!detector->held->usable) return fail(unusable), none;
  return guarded(__func__, none, [&] {
    return new touchmark_session{detector->held, detector->held->detector->begin_session()};
  });
}

void touchmark_session_free(touchmark_session* session) { delete session; }

int touchmark_touches(touchmark_session* session, const double center[3], double radius) {
  if (refuses_query(__func__, session, center, "center", "radius", radius)) return TOUCHMARK_ERROR;
  return session->detector().touches({point(center), radius}, *session->memory) ? TOUCHMARK_YES
                                                                                : TOUCHMARK_NO;
}

int touchmark_nearest(touchmark_session* session, const double center[3], double reach,
                      touchmark_contact* contact) {
  if (refuses_query(__func__, session, center, "center", "reach", reach)) return TOUCHMARK_ERROR;
  const std::optional<touchmark::Contact> found =
      session->detector().nearest({point(center), 0}, reach, *session->memory);
  if (!found) return TOUCHMARK_NO;
  if (contact != nullptr) store_contact(*found, *contact);
  return TOUCHMARK_YES;
}

int touchmark_first_hit(touchmark_session* session, const double from[3], const double to[3], double radius,
                        touchmark_impact* impact) {
  if (refuses_query(__func__, session, from, "from", "radius", radius)) return TOUCHMARK_ERROR;
  if (to == nullptr) return fail_for_null(__func__, "to");
  const std::optional<touchmark::Impact> found =
      session->detector().first_hit({point(from), point(to), radius}, *session->memory);
  if (!found) return TOUCHMARK_NO;
  if (impact != nullptr) {
    impact->fraction = found->fraction;
    store_contact(found->contact, impact->contact);
  }
  return TOUCHMARK_YES;
}

int touchmark_contacts(touchmark_session* session, const double center[3], double reach,
                       touchmark_contact* contacts, size_t capacity, size_t* count) {
  if (refuses_query(__func__, session, center, "center", "reach", reach)) return TOUCHMARK_ERROR;
  if (contacts == nullptr && capacity > 0) return fail_for_null(__func__, "contacts");
  if (count == nullptr) return fail_for_null(__func__, "count");
  return guarded(__func__, int{TOUCHMARK_ERROR}, [&] {
    if (session->contacts.size() < capacity) session->contacts.resize(capacity);
    const std::span<touchmark::Contact> into(session->contacts.data(), capacity);
    *count = session->detector().contacts({point(center), 0}, reach, *session->memory, into);
    for (std::size_t i = 0; i < std::min(*count, capacity); ++i) store_contact(into[i], contacts[i]);
    return int{*count > 0 ? TOUCHMARK_YES : TOUCHMARK_NO};
  });
}

int touchmark_prepare(touchmark_session* session) {
  if (session == nullptr) return fail_for_null(__func__, "session");
  if (!session->held->usable) return fail(unusable);
  session->detector().prepare(*session->memory);
  return TOUCHMARK_YES;
}
