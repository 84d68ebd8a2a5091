#include "bench/contestants/introduced.h"
#include "bench/contestants/own_options.h"
#include "core/field/certified_field.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark::bench::contestants {

namespace {

using Field = CertifiedField<SphereCluster>;

std::vector<named::Option> options_of(Field::Options& options) {
  return {
      named::length("error", options.error, "no answer is off by more", "1%").in_code("error"),
      named::length("band", options.band, "farther from the mesh sphere-cluster answers", "5%")
          .in_code("band"),
      named::choice<bool>("answers", options.refines, {{"field", false}, {"exact", true}},
                          "field: from memory alone; exact: sphere-cluster's, of what may be within reach")
          .in_code("refines"),
      named::threads_option(options.threads)};
}

}  // namespace

ContestantInfo field_entry() {
  Field::Options defaults;
  const std::vector<named::Option> table = options_of(defaults);
  ContestantInfo info =
      introduced("field", 45, "a sampled distance field whose error is proved, over sphere-cluster",
                 "approximate; answers=exact: exact");
  info.queries = queries_of<Field>();
  info.options.assign(table.begin(), table.end());
  info.options.push_back(side_option());
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    Field::Options options;
    set_options(options_of(options), values, mesh);
    options.exact.threads = options.threads;
    return contestant<Field>(mesh, options, values);
  };
  info.forms = {
      .verified = {"", "answers=exact"}, .frontier = {"error=0.3%", ""}, .tested = {"error=2%,threads=2"}};
  return info;
}

}  // namespace touchmark::bench::contestants
