/// A plug-in that is one of our own detectors: what it takes longer is what a plug-in's call costs.
#include <cstdio>
#include <exception>

#include "core/contestant.h"
#include "core/grid_group/grid_group.h"

namespace {

using touchmark::Contact;
using touchmark::GridGroup;
using touchmark::TriangleMesh;
using touchmark::Vec3;

// The same numbers in the same places. Copied here, they would be loaded as a vector before they are stored,
// which takes several times as long as the call.
const touchmark::Probe& own(const touchmark_plugin_probe& probe) {
  static_assert(sizeof(touchmark::Probe) == sizeof probe);
  return reinterpret_cast<const touchmark::Probe&>(probe);
}

Vec3 vec(const double* xyz) { return {xyz[0], xyz[1], xyz[2]}; }

TriangleMesh mesh_of(const touchmark_plugin_mesh& given) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (std::size_t i = 0; i < given.vertex_count; ++i) vertices.push_back(vec(given.vertices + 3 * i));
  for (std::size_t i = 0; i < given.triangle_count; ++i) {
    const std::uint32_t* corners = given.triangles + 3 * i;
    triangles.push_back({corners[0], corners[1], corners[2]});
  }
  return {std::move(vertices), std::move(triangles)};
}

void* build(const touchmark_plugin_mesh* mesh, const touchmark_plugin_setting* settings, std::size_t,
            char* error, std::size_t error_size) {
  try {
    GridGroup::Options options;
    options.cell = settings[0].number;
    return new GridGroup(GridGroup::build(mesh_of(*mesh), options));
  } catch (const std::exception& exception) {
    std::snprintf(error, error_size, "%s", exception.what());
    return nullptr;
  }
}

const GridGroup& grid(const void* detector) { return *static_cast<const GridGroup*>(detector); }
GridGroup::Session& memory(void* session) { return *static_cast<GridGroup::Session*>(session); }

void write(const Contact& found, touchmark_plugin_contact& contact) {
  for (int axis = 0; axis < 3; ++axis) {
    contact.point[axis] = found.point[axis];
    contact.normal[axis] = found.normal[axis];
  }
  contact.distance = found.distance;
  contact.triangle = found.triangle;
}

int touches(const void* detector, void* session, const touchmark_plugin_probe* probe) {
  return grid(detector).touches(own(*probe), memory(session)) ? 1 : 0;
}

int nearest(const void* detector, void* session, const touchmark_plugin_probe* probe, double reach,
            touchmark_plugin_contact* contact) {
  const auto found = grid(detector).nearest(own(*probe), reach, memory(session));
  if (!found) return 0;
  write(*found, *contact);
  return 1;
}

int first_hit(const void* detector, void* session, const touchmark_plugin_sweep* sweep,
              touchmark_plugin_impact* impact) {
  const auto found =
      grid(detector).first_hit({vec(sweep->from), vec(sweep->to), sweep->radius}, memory(session));
  if (!found) return 0;
  impact->fraction = found->fraction;
  write(found->contact, impact->contact);
  return 1;
}

int update(void* detector, const touchmark_plugin_mesh* mesh, char* error, std::size_t error_size) {
  try {
    static_cast<GridGroup*>(detector)->update(mesh_of(*mesh));
    return 0;
  } catch (const std::exception& exception) {
    std::snprintf(error, error_size, "%s", exception.what());
    return 1;
  }
}

constexpr touchmark_plugin_option options[]{
    {"cell", TOUCHMARK_PLUGIN_LENGTH, nullptr, "0", "edge of a cell; 0: chosen"}};

touchmark_plugin described() {
  touchmark_plugin plugin{};
  plugin.version = TOUCHMARK_PLUGIN_VERSION;
  plugin.name = "wrapped";
  plugin.summary = "the grid-group detector of this project, called as a plug-in";
  plugin.guarantee = "exact";
  plugin.options = options;
  plugin.option_count = 1;
  plugin.build = build;
  plugin.destroy = [](void* detector) { delete static_cast<GridGroup*>(detector); };
  plugin.bytes = [](const void* detector) { return grid(detector).bytes(); };
  plugin.accuracy = [](const void* detector, touchmark_plugin_accuracy* accuracy) {
    const touchmark::Accuracy own = grid(detector).accuracy();
    *accuracy = {own.relative, own.absolute, own.decides_exactly, own.names_exactly};
  };
  plugin.create_session = [](const void*) -> void* { return new GridGroup::Session; };
  plugin.destroy_session = [](const void*, void* session) { delete &memory(session); };
  plugin.touches = touches;
  plugin.nearest = nearest;
  plugin.first_hit = first_hit;
  plugin.update = update;
  return plugin;
}

}  // namespace

extern "C" TOUCHMARK_PLUGIN_EXPORT const touchmark_plugin* touchmark_plugin_entry() {
  static const touchmark_plugin plugin = described();
  return &plugin;
}
