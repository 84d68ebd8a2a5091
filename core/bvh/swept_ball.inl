// Which of eight triangles a moving ball surely does not touch (swept_ball.h), included at the end of
// traversal.inl. A plane is measured against all corners and both ends of the way, so that any normal proves
// what it proves; how it was found does not matter.

/// Four of the nine coordinates of a triangle.
using Quad [[gnu::vector_size(32)]] = double;

/// Turns four rows of four floats into columns, each of which goes to a row of the eight.
static void put_columns(const Lanes* rows, float (*to)[width], std::size_t at) noexcept {
  const std::array<Lanes, 4> columns = simd::columns(rows[0], rows[1], rows[2], rows[3]);
  for (std::size_t k = 0; k < columns.size(); ++k) std::memcpy(to[k] + at, &columns[k], sizeof(Lanes));
}

/// Reads the triangles in `count` slots, 1 to 8; the lanes beyond repeat the last.
static void gather(const PreparedTriangle* triangles, const std::uint32_t* slots, std::uint32_t count,
                   const SweptBall& ball, EightTriangles& eight) noexcept {
  const Vec3& f = ball.from;
  const Quad first_from = {f.x(), f.y(), f.z(), f.x()}, next_from = {f.y(), f.z(), f.x(), f.y()};
  const Quad scale = Quad{} + ball.scale;
  std::array<Lanes, width> first, next;
  for (std::uint32_t k = 0; k < width; ++k) {
    const double* const corners = triangles[slots[k < count ? k : count - 1]].corner[0].data();
    Quad four, other;
    std::memcpy(&four, corners, sizeof four);
    std::memcpy(&other, corners + 4, sizeof other);
    first[k] = __builtin_convertvector((first_from - four) * scale, Lanes);
    next[k] = __builtin_convertvector((next_from - other) * scale, Lanes);
    eight.to[8][k] = static_cast<float>((f.z() - corners[8]) * ball.scale);
  }
  for (std::uint32_t k = 0; k < width; k += 4) {
    put_columns(&first[k], eight.to, k);
    put_columns(&next[k], eight.to + 4, k);
  }
}

/// Three coordinates in each lane.
struct WideVec {
  Wide x, y, z;
};
/// a - b; no friend operator, on which GCC 12 crashes, compiled for AVX2 in a program that is linked as one.
static WideVec difference(const WideVec& a, const WideVec& b) noexcept {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
static Wide dot(const WideVec& a, const WideVec& b) noexcept { return (a.x * b.x + a.y * b.y) + a.z * b.z; }
/// a + part b
static WideVec moved(const WideVec& a, Wide part, const WideVec& b) noexcept {
  return {a.x + part * b.x, a.y + part * b.y, a.z + part * b.z};
}
static Wide magnitude(Wide a) noexcept { return max(a, -a); }
static Wide largest(const WideVec& a) noexcept {
  return max(magnitude(a.x), max(magnitude(a.y), magnitude(a.z)));
}
static Wide inverse_or_zero(Wide a) noexcept { return a > 0 ? 1 / a : Wide{}; }
static Wide clamp(Wide a, Wide low, Wide high) noexcept { return min(max(a, low), high); }

/// Part of the eight triangles, and the planes found for them. It has no constructor: GCC 12 crashes on one that
/// it makes for AVX2 in a program that is linked as one.
struct SweptLanes {
  std::array<WideVec, 3> to, edge;
  WideVec way;
  Wide until, radius, error;
  WideBits apart;
  WideVec normal;
  Wide height;

  /// Tries a plane across any direction.
  void try_plane(const WideVec& across) noexcept {
    constexpr float min_squared = 0x1p-80F, underflow = 0x1p-100F;
    const Wide squared = dot(across, across);
    const Wide length = square_root(squared);
    const Wide low = min(dot(across, to[0]), min(dot(across, to[1]), dot(across, to[2])));
    const Wide change = min(until * dot(across, way), Wide{});
    const WideBits is_apart =
        (low + change > (radius + error) * length + underflow) & (squared > Wide{} + min_squared) & ~apart;
    const Wide inverse = inverse_or_zero(length);
    normal.x = is_apart ? across.x * inverse : normal.x;
    normal.y = is_apart ? across.y * inverse : normal.y;
    normal.z = is_apart ? across.z * inverse : normal.z;
    height = is_apart ? low * inverse - error : height;
    apart |= is_apart;
  }
  /// Returns the vector from the triangle's border to the ball at a part of the way.
  WideVec from_border(Wide part) const noexcept {
    WideVec nearest{};
    Wide least = Wide{} + farthest;
    for (std::size_t i = 0; i < 3; ++i) {
      const WideVec there = moved(to[i], part, way);
      const Wide along = clamp(dot(there, edge[i]) * inverse_or_zero(dot(edge[i], edge[i])), Wide{}, Wide{} + 1);
      const WideVec off = moved(there, -along, edge[i]);
      const Wide squared = dot(off, off);
      const WideBits is_less = squared < least;
      nearest = {is_less ? off.x : nearest.x, is_less ? off.y : nearest.y, is_less ? off.z : nearest.z};
      least = is_less ? squared : least;
    }
    return nearest;
  }
};

/// Returns those of the eight that a plane surely keeps apart from the ball up to `until`, as bits, and the
/// planes: the face's, that across the border from about the place of the way nearest to the triangle, and
/// that from the place nearest to what was found so.
static unsigned kept_apart(const PreparedTriangle* triangles, const std::uint32_t* slots, std::uint32_t count,
                           const SweptBall& ball, EightPlanes& planes) noexcept {
  EightTriangles eight;
  gather(triangles, slots, count, ball, eight);
  unsigned found = 0;
  for (std::size_t at = 0; at < width; at += lanes) {
    SweptLanes swept{};
    swept.way = {Wide{} + ball.x, Wide{} + ball.y, Wide{} + ball.z};
    swept.until = Wide{} + ball.until;
    swept.radius = Wide{} + ball.radius;
    Wide size = largest(swept.way) + swept.radius;
    for (std::size_t i = 0; i < 3; ++i)
      swept.to[i] = {load(eight.to[3 * i] + at), load(eight.to[3 * i + 1] + at), load(eight.to[3 * i + 2] + at)};
    for (std::size_t i = 0; i < 3; ++i) swept.edge[i] = difference(swept.to[i], swept.to[i == 2 ? 0 : i + 1]);
    size += max(largest(swept.to[0]), max(largest(swept.to[1]), largest(swept.to[2])));
    swept.error = ball.rounding * size;
    const Wide inverse = inverse_or_zero(dot(swept.way, swept.way));
    const auto part_nearest_to = [&](Wide along) { return clamp(-along * inverse, Wide{}, swept.until); };
    const Wide middle =
        (dot(swept.to[0], swept.way) + dot(swept.to[1], swept.way) + dot(swept.to[2], swept.way)) * (1.0F / 3);
    const Wide first = part_nearest_to(middle);
    const WideVec off = swept.from_border(first);
    swept.try_plane(off);
    const WideVec &e = swept.edge[0], &f = swept.edge[1];
    const WideVec across = {e.y * f.z - e.z * f.y, e.z * f.x - e.x * f.z, e.x * f.y - e.y * f.x};
    const Wide side = dot(across, moved(swept.to[0], first, swept.way));
    swept.try_plane({side < 0 ? -across.x : across.x, side < 0 ? -across.y : across.y,
                     side < 0 ? -across.z : across.z});
    if (to_bits(swept.apart) != (1U << lanes) - 1) {
      const Wide second = part_nearest_to(dot(moved(off, -first, swept.way), swept.way));
      swept.try_plane(swept.from_border(second));
    }
    store(planes.x.data() + at, swept.normal.x);
    store(planes.y.data() + at, swept.normal.y);
    store(planes.z.data() + at, swept.normal.z);
    store(planes.height.data() + at, swept.height);
    found |= to_bits(swept.apart) << at;
  }
  return found & ((1U << count) - 1);
}
