/// The side of a place by the plainest detector.
#pragma once

#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/sign/signed_detector.h"

namespace touchmark::test {

using SignedBruteForce = Signed<BruteForce>;

inline Side side_at(const SignedBruteForce& detector, const Vec3& center) {
  SignedBruteForce::Session session;
  const auto contact = detector.nearest({center, 0}, infinity, session);
  return contact ? contact->side : Side::unasked;
}

}  // namespace touchmark::test
