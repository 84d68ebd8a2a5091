#include "bench/contestants/entry.h"

#include <optional>
#include <stdexcept>

#include "baselines/embree/embree_detector.h"
#include "baselines/embree/embree_scene.h"
#include "baselines/embree/frame.h"
#include "bench/contestants/introduced.h"
#include "bench/contestants/rival_options.h"
#include "bench/contestants/rival_scene.h"

namespace touchmark::bench::contestants {

ContestantInfo embree_entry() {
  ContestantInfo info = introduced(
      "embree", 80, "Embree: point query over its hierarchy, this project's kernel as the callback",
      "exact; geometry=triangle: approximate");
  using baselines::EmbreeDetector;
  using Geometry = EmbreeDetector::Geometry;
  using Quality = EmbreeDetector::Quality;
  static const Names<Geometry> geometries{{"user", Geometry::user},
                                          {"triangle", Geometry::triangle},
                                          {"triangle_exact", Geometry::triangle_exact}};
  static const Names<Quality> qualities{
      {"medium", Quality::medium}, {"high", Quality::high}, {"refit", Quality::refit}};
  info.queries = queries_of<EmbreeDetector>();
  info.options = {
      choice("geometry", geometries,
             "user: boxes of our own, rounded outward; triangle: Embree's triangles and their closest points "
             "in single precision; triangle_exact: Embree's boxes, this project's kernel"),
      choice("quality", qualities,
             "Embree's; refit: updates refit the hierarchy instead of building it anew"),
      choice("warm", yes_or_no, "start from the distance of the session's last triangle"), query_option()};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    return contestant<EmbreeDetector>(
        mesh, {chosen(values, "geometry", geometries), chosen(values, "quality", qualities),
               chosen(values, "warm", yes_or_no), asking(values)});
  };
  info.build_scene = build_rival_scene<baselines::EmbreeScene>([](const OptionValues& values) {
    if (chosen(values, "geometry", geometries) != Geometry::user)
      throw std::invalid_argument("of a scene of bodies there is only geometry=user");
    return EmbreeDetector::Options{Geometry::user, chosen(values, "quality", qualities),
                                   chosen(values, "warm", yes_or_no), asking(values)};
  });
  info.storage_rounding = [](const TriangleMesh& mesh,
                             const OptionValues& values) -> std::optional<StorageRounding> {
    if (chosen(values, "geometry", geometries) != Geometry::triangle) return std::nullopt;
    const baselines::EmbreeFrame frame(mesh.bounds());
    return stored_in_single_precision(frame.scale, frame.origin);
  };
  info.forms = {.compared = {"", "query=plain", "geometry=triangle"},
                .verified = {"geometry=triangle_exact", "geometry=triangle,query=plain"},
                .frontier = {"", "geometry=triangle"},
                .scaled = {""},
                .updated = {"", "quality=refit"},
                .suite = {"", "geometry=triangle"},
                .scenes = {""}};
  return info;
}

}  // namespace touchmark::bench::contestants
