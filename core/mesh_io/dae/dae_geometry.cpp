#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>

#include <pugixml.hpp>

#include "core/mesh_io/dae/dae_parts.h"

namespace touchmark::mesh_io {
namespace {

using pugi::xml_node;
using Corners = std::vector<std::uint32_t>;

/// Returns where in a tuple of the accessor x, y and z are. Values of unnamed params belong to something
/// else.
std::vector<std::size_t> places_of_coordinates(const DaeDocument& document, const xml_node& accessor) {
  std::vector<std::size_t> places;
  std::string names;
  std::size_t params = 0;
  for (const xml_node& param : accessor.children("param")) {
    const std::string_view name = document.attribute(param, "name");
    if (!name.empty()) places.push_back(params);
    names += name;
    ++params;
  }
  if (places.size() != 3 || (names != "XYZ" && names != "xyz"))
    document.fail(accessor, "its named params are ", mesh_io::quoted(names),
                  "; a position has X, Y and Z, in this order");
  const std::size_t stride = document.count_or(accessor, "stride", 1);
  if (params > stride) document.fail(accessor, "has ", params, " params, but its stride is ", stride);
  return places;
}

/// Returns the positions that an accessor reads from its array, all of whose numbers are checked.
std::vector<Vec3> positions(const DaeDocument& document, const xml_node& accessor) {
  const xml_node array = document.target(accessor, "source", {"float_array", "int_array"});
  const std::vector<double> numbers = document.numbers(array);
  if (const std::size_t stated = document.count(array, "count"); stated != numbers.size())
    document.fail(array, "has ", numbers.size(), " numbers, but its count is ", stated);
  const std::vector<std::size_t> places = places_of_coordinates(document, accessor);
  const std::size_t count = document.count(accessor, "count"),
                    offset = document.count_or(accessor, "offset", 0),
                    stride = document.count_or(accessor, "stride", 1), width = places.back() + 1;
  const bool first_fits = offset <= numbers.size() && width <= numbers.size() - offset;
  if (count > 0 && !(first_fits && count - 1 <= (numbers.size() - offset - width) / stride))
    document.fail(accessor, "count ", count, ", stride ", stride, " and offset ", offset,
                  " reach beyond the ", numbers.size(), " numbers of its array");
  std::vector<Vec3> positions(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double* tuple = numbers.data() + offset + i * stride;
    positions[i] = {tuple[places[0]], tuple[places[1]], tuple[places[2]]};
  }
  return positions;
}

/// How the numbers of <p> make corners.
struct Layout {
  std::size_t width = 0;   ///< numbers a corner
  std::size_t vertex = 0;  ///< the one that names a vertex
};

class PartReader {
 public:
  explicit PartReader(const DaeDocument& document) : document_(document) {}

  void add_mesh(const xml_node& mesh) {
    for (const xml_node& child : mesh.children()) {
      const std::string_view name = child.name();
      if (child.type() != pugi::node_element || name == "extra" || name == "source" || name == "vertices")
        continue;
      if (name == "lines" || name == "linestrips") continue;  // no faces
      add_primitive(child, name);
    }
  }
  SceneGraph::Part part() && { return std::move(part_); }

 private:
  void add_primitive(const xml_node& primitive, std::string_view name) {
    const bool is_list = name == "triangles" || name == "polylist";
    if (!is_list && name != "polygons" && name != "tristrips" && name != "trifans")
      document_.fail_unknown(primitive);
    if (primitive.child("ph"))
      document_.fail(primitive.child("ph"), "polygons with holes are not read; export triangles");
    const Layout layout = read_inputs(primitive);
    if (name == "triangles") return add_triangle_list(primitive, layout);
    if (name == "polylist") return add_polygon_list(primitive, layout);
    std::size_t lists = 0;
    for (const xml_node& p : primitive.children("p")) {
      const Corners corners = read_corners(p, layout);
      if (corners.size() < 3) document_.fail(p, "has ", corners.size(), " corners; it takes at least 3");
      if (name == "polygons") {
        add_face(primitive, corners);
      } else {
        add_triangles(primitive, corners, name == "tristrips");
      }
      ++lists;
    }
    expect_count(primitive, lists, "<p>");
  }

  void expect_count(const xml_node& primitive, std::size_t found, const char* what) const {
    if (const std::size_t stated = document_.count(primitive, "count"); stated != found)
      document_.fail(primitive, "has ", found, " ", what, ", but its count is ", stated);
  }

  xml_node input(const xml_node& element, std::string_view semantic) const {
    xml_node found;
    for (const xml_node& input : element.children("input")) {
      if (document_.attribute(input, "semantic") != semantic) continue;
      if (found) document_.fail(input, "is a second input ", semantic);
      found = input;
    }
    if (!found) document_.fail(element, "has no input ", semantic);
    return found;
  }

  /// Finds the vertices, which all primitives share.
  Layout read_inputs(const xml_node& primitive) {
    const xml_node vertex = input(primitive, "VERTEX"),
                   vertices = document_.target(vertex, "source", {"vertices"});
    if (vertices_ && vertices_ != vertices)
      document_.fail(vertex, "the primitives before it have other vertices");
    if (!vertices_) read_vertices(vertices);
    Layout layout = {0, document_.count(vertex, "offset")};
    for (const xml_node& input : primitive.children("input"))
      layout.width = std::max(layout.width, document_.count(input, "offset") + 1);
    return layout;
  }

  void read_vertices(const xml_node& vertices) {
    vertices_ = vertices;
    const xml_node source = document_.target(input(vertices, "POSITION"), "source", {"source"});
    const xml_node common = document_.only_child(source, "technique_common");
    const xml_node accessor = document_.only_child(common, "accessor");
    if (!accessor) document_.fail(source, "has no <accessor>");
    part_.vertices = positions(document_, accessor);
  }

  /// Returns the vertices that a list names; it may be missing.
  Corners read_corners(const xml_node& p, const Layout& layout) const {
    Corners corners;
    if (!p) return corners;
    const DaeDocument::Words words = document_.words(p);
    TextCursor cursor = words.cursor();
    std::size_t numbers = 0;
    for (; !cursor.at_end(); ++numbers) {
      const std::int64_t number = cursor.integer(words.what);
      const bool is_vertex = numbers % layout.width == layout.vertex;
      if (number < 0 || (is_vertex && static_cast<std::uint64_t>(number) >= part_.vertices.size()))
        cursor.fail(text_of(words.what, " of corner ", numbers / layout.width, " names ",
                            is_vertex ? "vertex " : "value ", number, " of ",
                            is_vertex ? std::to_string(part_.vertices.size()) : "another input"));
      if (is_vertex) corners.push_back(static_cast<std::uint32_t>(number));
    }
    if (numbers % layout.width != 0)
      document_.fail(p, "has ", numbers, " numbers, which ", layout.width, " a corner do not divide");
    return corners;
  }

  void add_triangle_list(const xml_node& primitive, const Layout& layout) {
    const Corners corners = read_corners(document_.only_child(primitive, "p"), layout);
    if (corners.size() % 3 != 0) document_.fail(primitive, corners.size(), " corners are no whole triangles");
    expect_count(primitive, corners.size() / 3, "triangles");
    for (std::size_t i = 0; i < corners.size(); i += 3) add_face(primitive, std::span(corners).subspan(i, 3));
  }

  void add_polygon_list(const xml_node& primitive, const Layout& layout) {
    const Corners corners = read_corners(document_.only_child(primitive, "p"), layout);
    std::size_t begin = 0, polygons = 0;
    if (const xml_node vcount = document_.only_child(primitive, "vcount")) {
      const DaeDocument::Words words = document_.words(vcount);
      for (TextCursor cursor = words.cursor(); !cursor.at_end(); ++polygons) {
        const std::int64_t size = cursor.integer(words.what);
        if (size < 3 || static_cast<std::uint64_t>(size) > corners.size() - begin)
          cursor.fail(text_of(words.what, " of polygon ", polygons, ": ", size,
                              " corners; it takes at least 3, and ", corners.size() - begin, " are left"));
        add_face(primitive, std::span(corners).subspan(begin, static_cast<std::size_t>(size)));
        begin += static_cast<std::size_t>(size);
      }
    }
    if (begin != corners.size())
      document_.fail(primitive, "has ", corners.size(), " corners, but its vcount names ", begin);
    expect_count(primitive, polygons, "polygons");
  }

  /// Strips turn every second triangle. A triangle that names a vertex twice only leads on to the next one.
  void add_triangles(const xml_node& primitive, const Corners& corners, bool is_strip) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const std::uint32_t a = is_strip ? corners[i - 2] : corners[0], b = corners[i - 1], c = corners[i];
      if (a == b || b == c || c == a) continue;
      const bool turns = is_strip && i % 2 == 1;
      add_face(primitive, std::array{turns ? b : a, turns ? a : b, c});
    }
  }

  void add_face(const xml_node& primitive, std::span<const std::uint32_t> corners) {
    constexpr std::size_t max_corners = std::numeric_limits<std::uint32_t>::max();
    if (part_.corners.size() + corners.size() > max_corners)
      document_.fail(primitive, "goes beyond ", max_corners, " corners");
    part_.corners.insert(part_.corners.end(), corners.begin(), corners.end());
    part_.ends.push_back(static_cast<std::uint32_t>(part_.corners.size()));
  }

  const DaeDocument& document_;
  SceneGraph::Part part_;
  xml_node vertices_;
};

}  // namespace

SceneGraph::Part dae_part(const DaeDocument& document, const xml_node& geometry) {
  for (const char* curved : {"spline", "brep"})
    if (geometry.child(curved)) document.fail(geometry.child(curved), "is not read; export it as triangles");
  xml_node mesh = document.only_child(geometry, "mesh");
  if (!mesh) mesh = document.only_child(geometry, "convex_mesh");
  if (!mesh) document.fail(geometry, "has no <mesh>");
  if (mesh.attribute("convex_hull_of"))
    document.fail(mesh, "convex_hull_of is not read; export the hull's triangles");
  PartReader reader(document);
  reader.add_mesh(mesh);
  return std::move(reader).part();
}

}  // namespace touchmark::mesh_io
