// A detector that looks at every triangle, every time. Put yours in its place: `build` makes it of a mesh,
// `nearest` is what it answers, and touchmark_plugin_entry says what it is and what it claims.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <touchmark/contestant.h>

namespace {

using Vec = std::array<double, 3>;
Vec operator-(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vec operator+(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vec operator*(double s, const Vec& a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Vec& a) { return std::sqrt(dot(a, a)); }
Vec vec(const double* xyz) { return {xyz[0], xyz[1], xyz[2]}; }

using Triangle = std::array<Vec, 3>;
using Mine = std::vector<Triangle>;
const Mine& mine(const void* detector) { return *static_cast<const Mine*>(detector); }

// The point of the segment that is nearest to the origin.
Vec nearest_on_segment(const Vec& a, const Vec& b) {
  const double squared = dot(b - a, b - a);
  return squared > 0 ? a + std::clamp(-dot(a, b - a) / squared, 0.0, 1.0) * (b - a) : a;
}

// The point of the triangle that is nearest to the origin: its foot in the plane, or a point of an edge.
Vec nearest_on_triangle(const Vec& a, const Vec& b, const Vec& c) {
  const Vec normal = cross(b - a, c - a);
  if (dot(normal, cross(a, b)) > 0 && dot(normal, cross(b, c)) > 0 && dot(normal, cross(c, a)) > 0)
    return (dot(normal, a) / dot(normal, normal)) * normal;
  Vec best = nearest_on_segment(a, b);
  for (const Vec& point : {nearest_on_segment(b, c), nearest_on_segment(c, a)})
    if (dot(point, point) < dot(best, best)) best = point;
  return best;
}

void* build(const touchmark_plugin_mesh* mesh, const touchmark_plugin_setting*, size_t, char*, size_t) {
  Mine* const made = new Mine;
  for (const uint32_t* corner = mesh->triangles; made->size() < mesh->triangle_count; corner += 3)
    made->push_back({vec(mesh->vertices + 3 * corner[0]), vec(mesh->vertices + 3 * corner[1]),
                     vec(mesh->vertices + 3 * corner[2])});
  return made;
}
void destroy(void* detector) { delete static_cast<Mine*>(detector); }
size_t bytes(const void* detector) { return mine(detector).capacity() * sizeof(Triangle); }

int nearest(const void* detector, void*, const touchmark_plugin_probe* probe, double reach,
            touchmark_plugin_contact* contact) {
  const Vec center = vec(probe->center);
  double best = INFINITY;
  Vec way{};  // from the center to the point
  for (size_t i = 0; i < mine(detector).size(); ++i) {
    const auto& [a, b, c] = mine(detector)[i];
    const Vec candidate = nearest_on_triangle(a - center, b - center, c - center);
    if (!(length(candidate) < best)) continue;
    best = length(candidate);
    way = candidate;
    contact->triangle = static_cast<uint32_t>(i);
  }
  if (!(best <= reach)) return 0;
  const auto& [a, b, c] = mine(detector)[contact->triangle];
  const Vec out = best > 0 ? -1.0 * way : cross(b - a, c - a);  // 0 on a triangle that is a line or a point
  const Vec normal = length(out) > 0 ? (1 / length(out)) * out : Vec{0, 0, 1};
  const Vec point = center + way;
  std::copy(point.begin(), point.end(), contact->point);
  std::copy(normal.begin(), normal.end(), contact->normal);
  contact->distance = best;
  return 1;
}
int touches(const void* detector, void* session, const touchmark_plugin_probe* probe) {
  touchmark_plugin_contact contact{};
  return nearest(detector, session, probe, probe->radius, &contact);
}

}  // namespace

extern "C" TOUCHMARK_PLUGIN_EXPORT const touchmark_plugin* touchmark_plugin_entry(void) {
  static touchmark_plugin plugin{};  // what is not set is not there: options, sessions, first_hit, update
  plugin.version = TOUCHMARK_PLUGIN_VERSION;
  plugin.name = "mine";
  plugin.summary = "every triangle, every time";
  plugin.guarantee = "exact";
  plugin.build = build;
  plugin.destroy = destroy;
  plugin.bytes = bytes;
  plugin.touches = touches;
  plugin.nearest = nearest;
  return &plugin;
}
