/// Noise by place: the same number at the same place, on every machine.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/probe.h"

namespace touchmark::bench::meshes {

/// Returns well-mixed bits of one number: the finaliser of Steele, Lea and Flood's SplitMix64 (2014).
inline std::uint64_t mixed(std::uint64_t x) noexcept {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Returns a number in [-1, 1), from bits.
inline double signed_unit(std::uint64_t bits) noexcept {
  return static_cast<double>(bits >> 11) * 0x1p-52 - 1;
}

/// Returns the value of a smooth random field in [-1, 1] whose bumps are one unit wide: random values at the
/// corners of a lattice, blended.
inline double bumps(const Vec3& at, std::uint64_t seed) noexcept {
  const Vec3 base(std::floor(at.x()), std::floor(at.y()), std::floor(at.z()));
  const Vec3 part = at - base;
  const Vec3 blend = part.cwiseProduct(part).cwiseProduct(Vec3::Constant(3) - 2 * part);
  const auto value = [&](int dx, int dy, int dz) {
    // Lattice coordinates stay far below 2^20.
    const auto x = static_cast<std::uint64_t>(static_cast<std::int64_t>(base.x()) + dx + (1 << 20));
    const auto y = static_cast<std::uint64_t>(static_cast<std::int64_t>(base.y()) + dy + (1 << 20));
    const auto z = static_cast<std::uint64_t>(static_cast<std::int64_t>(base.z()) + dz + (1 << 20));
    return signed_unit(mixed(((x << 42) | (y << 21) | z) ^ seed));
  };
  const auto along = [](double a, double b, double t) { return a + t * (b - a); };
  const auto row = [&](int dy, int dz) { return along(value(0, dy, dz), value(1, dy, dz), blend.x()); };
  const auto plane = [&](int dz) { return along(row(0, dz), row(1, dz), blend.y()); };
  return along(plane(0), plane(1), blend.z());
}

}  // namespace touchmark::bench::meshes
