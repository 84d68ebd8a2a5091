#include "bench/contestants/entry.h"
#include "core/field/certified_field.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark::bench::contestants {

ContestantInfo field_entry() {
  using Field = CertifiedField<SphereCluster>;
  static const Names<bool> answers{{"field", false}, {"exact", true}};
  ContestantInfo info;
  info.name = "field";
  info.rank = 45;
  info.summary = "a sampled distance field whose error is proved, over sphere-cluster";
  info.accuracy = "approximate; answers=exact: exact";
  info.queries = queries_of<Field>();
  info.options = {
      in_code({"error", OptionKind::length, {}, "1%", "no answer is off by more"}, "error"),
      in_code({"band", OptionKind::length, {}, "5%", "farther from the mesh sphere-cluster answers"}, "band"),
      in_code(choice("answers", answers,
                     "field: from memory alone; exact: sphere-cluster's, of what may be within reach"),
              "refines"),
      threads_option(), side_option()};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    Field::Options options;
    options.error = values.length("error", mesh);
    options.band = values.length("band", mesh);
    options.refines = chosen(values, "answers", answers);
    options.threads = options.exact.threads = threads_of(values);
    return contestant<Field>(mesh, options, values);
  };
  info.forms = {
      .verified = {"", "answers=exact"}, .frontier = {"error=0.3%", ""}, .tested = {"error=2%,threads=2"}};
  return info;
}

}  // namespace touchmark::bench::contestants
