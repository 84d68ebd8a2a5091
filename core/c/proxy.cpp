// The proxy of core/c/touchmark.h.
#include "core/haptics/proxy.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "core/c/handles.h"
#include "core/c/touchmark.h"
#include "core/haptics/coupling.h"
#include "core/mesh_motion.h"
#include "core/named/named_detector.h"

using namespace touchmark::c;
using touchmark::Coupling;
using touchmark::ForcePlanes;
using touchmark::MeshMotion;
using touchmark::NamedDetector;
using touchmark::Proxy;
using touchmark::ProxyState;
using touchmark::ProxyStatus;

struct touchmark_proxy {
  touchmark_proxy(std::shared_ptr<const Held> detector, const Coupling& coupling)
      : held(std::move(detector)),
        memory(held->detector->begin_session()),
        updates(held->updates),
        proxy(*held->detector, coupling, held->mesh.get()) {
    held->detector->expect_limited(coupling.max_work, *memory);
  }

  /// Forgets what it knew of the surface, if that was updated.
  void see_updates() noexcept {
    if (updates == held->updates) return;
    updates = held->updates;
    proxy.surface_moved(held->mesh.get());
  }

  std::shared_ptr<const Held> held;
  std::unique_ptr<NamedDetector::Session> memory;
  std::uint64_t updates;  ///< The detector had so many when the proxy last saw it.
  Proxy<NamedDetector> proxy;
  bool placed = false;
};

namespace {

Coupling coupling_of(const touchmark_coupling* from) {
  if (from == nullptr) return {};
  const Coupling coupling{.radius = from->radius,
                          .stiffness = from->stiffness,
                          .static_friction = from->static_friction,
                          .dynamic_friction = from->dynamic_friction,
                          .damping = from->damping,
                          .tick_s = from->tick_s,
                          .max_work = from->max_work};
  expect_usable(coupling);
  return coupling;
}

void store_state(const ProxyState& from, touchmark_proxy_state& to) noexcept {
  store(from.position, to.position);
  store(from.force, to.force);
  to.status = static_cast<std::int32_t>(from.status);
  to.contacts = static_cast<std::uint32_t>(from.contacts);
  to.flags = from.unfinished ? TOUCHMARK_PROXY_UNFINISHED : 0;
  for (std::size_t i = 0; i < from.contacts; ++i) store(from.normals[i], to.normals[i]);
}

static_assert(static_cast<int>(ProxyStatus::free) == TOUCHMARK_PROXY_FREE &&
              static_cast<int>(ProxyStatus::in_contact) == TOUCHMARK_PROXY_IN_CONTACT &&
              static_cast<int>(ProxyStatus::stuck) == TOUCHMARK_PROXY_STUCK &&
              static_cast<int>(ProxyStatus::unanswered) == TOUCHMARK_PROXY_UNANSWERED);

}  // namespace

int touchmark_coupling_default(touchmark_coupling* coupling) {
  if (coupling == nullptr) return fail_for_null(__func__, "coupling");
  constexpr Coupling usual;
  *coupling = {usual.radius,  usual.stiffness, usual.static_friction, usual.dynamic_friction,
               usual.damping, usual.tick_s,    usual.max_work};
  return TOUCHMARK_YES;
}

touchmark_proxy* touchmark_proxy_create(const touchmark_detector* detector,
                                        const touchmark_coupling* coupling) {
  touchmark_proxy* const none = nullptr;
  if (detector == nullptr) return fail_for_null(__func__, "detector"), none;
  if (!detector->held->usable) return fail(unusable), none;
  if (!detector->held->detector->accuracy().decides_exactly)
    return fail("touchmark_proxy_create: the detector does not decide exactly, so the proxy could cross"),
           none;
  return guarded(__func__, none, [&] { return new touchmark_proxy(detector->held, coupling_of(coupling)); });
}

void touchmark_proxy_free(touchmark_proxy* proxy) { delete proxy; }

int touchmark_proxy_place(touchmark_proxy* proxy, const double position[3]) {
  if (proxy == nullptr) return fail_for_null(__func__, "proxy");
  if (position == nullptr) return fail_for_null(__func__, "position");
  if (!point(position).allFinite()) return fail("touchmark_proxy_place: position is not finite");
  proxy->proxy.place(point(position));
  proxy->placed = true;
  return TOUCHMARK_YES;
}

int touchmark_proxy_surface_moving(touchmark_proxy* proxy, const touchmark_mesh* mesh) {
  if (proxy == nullptr) return fail_for_null(__func__, "proxy");
  if (mesh == nullptr) return fail_for_null(__func__, "mesh");
  if (!proxy->held->usable) return fail(unusable);
  if (!proxy->placed)
    return fail("touchmark_proxy_surface_moving: the proxy was never placed: call touchmark_proxy_place");
  return guarded(__func__, int{TOUCHMARK_ERROR}, [&] {
    proxy->held->detector->expect_sees_mesh_motion();
    const MeshMotion motion(*proxy->held->mesh, *mesh->mesh);
    proxy->see_updates();
    return proxy->proxy.surface_moving(motion, *proxy->memory) ? int{TOUCHMARK_YES} : int{TOUCHMARK_NO};
  });
}

int touchmark_proxy_step(touchmark_proxy* proxy, const double goal[3], touchmark_proxy_state* state) {
  if (proxy == nullptr) return fail_for_null(__func__, "proxy");
  if (goal == nullptr) return fail_for_null(__func__, "goal");
  if (!proxy->held->usable) return fail(unusable);
  if (!proxy->placed)
    return fail("touchmark_proxy_step: the proxy was never placed: call touchmark_proxy_place");
  proxy->see_updates();
  const ProxyState& now = proxy->proxy.step(point(goal), *proxy->memory);
  if (state != nullptr) store_state(now, *state);
  return now.contacts > 0 ? TOUCHMARK_YES : TOUCHMARK_NO;
}

int touchmark_proxy_planes(const touchmark_proxy* proxy, touchmark_force_planes* planes) {
  if (proxy == nullptr) return fail_for_null(__func__, "proxy");
  if (planes == nullptr) return fail_for_null(__func__, "planes");
  *planes = std::bit_cast<touchmark_force_planes>(proxy->proxy.planes());
  return TOUCHMARK_YES;
}

int touchmark_force_now(const touchmark_force_planes* planes, const double goal[3], double force[3]) {
  if (planes == nullptr) return fail_for_null(__func__, "planes");
  if (goal == nullptr) return fail_for_null(__func__, "goal");
  if (force == nullptr) return fail_for_null(__func__, "force");
  store(std::bit_cast<ForcePlanes>(*planes).force(point(goal)), force);
  return TOUCHMARK_YES;
}
