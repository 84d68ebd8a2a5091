#include <limits>
#include <string>
#include <vector>

#include "bench/contestants/build_notes.h"
#include "bench/contestants/entry.h"
#include "core/auto/auto_detector.h"

namespace touchmark::bench::contestants {

namespace {

using Chosen = std::optional<Form>;

const Names<Chosen>& forms() {
  static const Names<Chosen> names{{"by-mesh", std::nullopt},
                                   {"sphere-cluster", Form::sphere_cluster},
                                   {"grid-group", Form::grid_group},
                                   {"aabb-tree", Form::aabb_tree}};
  return names;
}

const Names<Wish::Query>& queries() {
  static const Names<Wish::Query> names{{"any", Wish::Query::any},
                                        {"touches", Wish::Query::touches},
                                        {"nearest", Wish::Query::nearest},
                                        {"sweep", Wish::Query::sweep}};
  return names;
}

std::vector<OptionInfo> options() {
  return {
      in_code(choice("query", queries(), "what is going to be asked most"), "query", "Wish::Query"),
      in_code({"reach", OptionKind::length, {}, "0", "how far it is going to look; 0: not known"}, "reach"),
      in_code({"speed", OptionKind::length, {}, "0", "by how far the point moves a tick; 0: not known"},
              "speed"),
      {"bytes_per_triangle", OptionKind::number, {}, "0", "what the structure may take; 0: any"},
      in_code({"trial", OptionKind::number, {}, "0", "milliseconds to try out which is faster"}, "trial_ms"),
      choice("prepare", no_or_yes, "true: prepare before each query, clocked apart"),
      updated_option(),
      side_option(),
      in_code(choice("chose", forms(), "by-mesh: the one that suits the mesh, as results.csv then says"),
              "form", "Form")};
}

std::optional<double> known(double length) { return length > 0 ? std::optional(length) : std::nullopt; }

Wish wish_of(const TriangleMesh& mesh, const OptionValues& values) {
  Wish wish;
  wish.query = chosen(values, "query", queries());
  wish.reach = known(values.length("reach", mesh));
  wish.speed = known(values.length("speed", mesh));
  if (const double bytes = values.number("bytes_per_triangle"); bytes > 0)
    wish.max_bytes = bytes * static_cast<double>(mesh.size());
  wish.trial_ms = values.number("trial");
  wish.form = chosen(values, "chose", forms());
  return wish;
}

}  // namespace

ContestantInfo auto_entry() {
  ContestantInfo info;
  info.name = "auto";
  info.rank = 45;
  info.summary = "sphere-cluster, grid-group or aabb-tree, whichever suits the mesh";
  info.accuracy = "exact";
  info.queries = queries_of<AutoDetector>();
  info.options = options();
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    const Wish wish = wish_of(mesh, values);
    const auto note = [&](const AutoDetector& detector) {
      if (!wish.form) note_choice("chose=" + std::string(name_of(detector.choice().form())));
      return std::string();
    };
    return chosen(values, "prepare", no_or_yes)
               ? contestant<AutoDetector, Prefetch::on>(mesh, wish, values, note)
               : contestant<AutoDetector>(mesh, wish, values, note);
  };
  info.library = {"auto_detector", "AutoDetector"};
  info.forms = {.verified = {"", "prepare=true", "updated=true", "chose=grid-group", "chose=aabb-tree"},
                .chosen = {""},
                .suite = {""}};
  return info;
}

}  // namespace touchmark::bench::contestants
