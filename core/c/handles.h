/// What stands behind the handles of core/c/touchmark.h, and how its functions fail.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "core/c/touchmark.h"
#include "core/named/named_detector.h"
#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark::c {

/// Outlives its handle for as long as a session or a proxy needs it.
struct Held {
  std::unique_ptr<NamedDetector> detector;
  std::shared_ptr<const TriangleMesh> mesh;
  std::uint64_t updates = 0;  ///< a proxy that has seen fewer forgets what it knows of the surface
  bool usable = true;         ///< false after an update that failed half-way
};

inline constexpr std::string_view unusable = "the detector's last update failed half-way: build it anew";

/// Each makes a text the last error of this thread, and returns TOUCHMARK_ERROR.
int fail(std::string_view message) noexcept;
int fail_for_null(const char* function, const char* argument) noexcept;
int fail_for_size(const char* function, const char* argument, double value) noexcept;

/// Calls make(), whose exceptions become the last error and `failed`.
template <class Result, class Make>
Result guarded(const char* function, Result failed, const Make& make) noexcept {
  try {
    return make();
  } catch (const std::bad_alloc&) {
    fail("out of memory");
  } catch (const std::length_error&) {
    fail("out of memory");
  } catch (const std::exception& error) {
    std::array<char, 1024> message{};
    std::snprintf(message.data(), message.size(), "%s: %s", function, error.what());
    fail(message.data());
  } catch (...) {
    fail("an exception of no known kind");
  }
  return failed;
}

/// Returns true if a query's session or centre is NULL, or its radius or reach is none. What is wrong has
/// become the last error.
bool refuses(const char* function, const void* session, const double* center, const char* center_name,
             const char* size_name, double size) noexcept;

inline Vec3 point(const double coordinates[3]) noexcept {
  return {coordinates[0], coordinates[1], coordinates[2]};
}
inline void store(const Vec3& from, double to[3]) noexcept {
  for (int k = 0; k < 3; ++k) to[k] = from[k];
}
inline void store_contact(const Contact& from, touchmark_contact& to) noexcept {
  store(from.point, to.point);
  store(from.normal, to.normal);
  to.distance = from.distance;
  to.triangle = from.triangle;
  to.side = static_cast<std::int32_t>(from.side);
}

}  // namespace touchmark::c

struct touchmark_mesh {
  std::shared_ptr<const touchmark::TriangleMesh> mesh;
};

struct touchmark_detector {
  std::shared_ptr<touchmark::c::Held> held;
};

struct touchmark_session {
  std::shared_ptr<const touchmark::c::Held> held;
  std::unique_ptr<touchmark::NamedDetector::Session> memory;
  std::vector<touchmark::Contact> contacts = {};  ///< as many as were ever asked for at once

  const touchmark::NamedDetector& detector() const noexcept { return *held->detector; }
};
