/// All triangles within a reach, through the tree of boxes.
#include <cmath>
#include <cstdint>

#include "core/aabb_tree/aabb_tree.h"
#include "core/search/contacts_within.h"

namespace touchmark {

std::size_t AabbTree::contacts(const Probe& probe, double reach, Session& session,
                               std::span<Contact> into) const noexcept {
  const Vec3& center = probe.center;
  if (!(reach >= 0) || !center.allFinite()) return 0;
  ContactsWithin found({triangles_, bounds(), ids_, center, reach, into, certified_});
  if (std::isinf(found.error())) return fallback().contacts(center, reach, into, session.work);
  for_each_near(center, reach + found.error(), session.work, [&](const PreparedTriangle& triangle) {
    found.consider(static_cast<std::uint32_t>(&triangle - triangles_.data()), session.work);
  });
  return found.finish(session.work);
}

}  // namespace touchmark
