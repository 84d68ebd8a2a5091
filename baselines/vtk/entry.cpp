#include "bench/contestants/entry.h"

#include <stdexcept>
#include <string>

#include "baselines/vtk/vtk_detector.h"
#include "bench/contestants/introduced.h"
#include "bench/contestants/rival_module.h"
#include "bench/contestants/rival_options.h"

namespace touchmark::bench::contestants {

ContestantInfo vtk_entry() {
  using baselines::VtkDetector;
  using Locator = VtkDetector::Locator;
  static const Names<Locator> locators{{"static", Locator::fixed}, {"implicit", Locator::implicit}};
  static const std::string module = "vtk";
  ContestantInfo info = introduced(
      module, 120, "VTK: its static cell locator, or its implicit distance of a mesh", "approximate");
  info.queries = queries_of<VtkDetector>();
  info.options = {choice("locator", locators,
                         "static: vtkStaticCellLocator within a radius; implicit: "
                         "vtkImplicitPolyDataDistance, at any distance; no triangle is named"),
                  {"cells", OptionKind::count, {}, "0", "of static: triangles a bin; 0: VTK's own 10"},
                  query_option()};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    constexpr std::size_t max_cells = 1'000'000;
    if (values.count("cells") > max_cells) throw std::invalid_argument("cells is more than a million");
    const VtkDetector::Options options{chosen(values, "locator", locators),
                                       static_cast<std::uint32_t>(values.count("cells")), asking(values)};
    return contestant_of_module(module, mesh, options);
  };
  comes_from_module(info, module);
  info.forms = {.verified = {"", "locator=implicit"}, .frontier = {"", "cells=1", "locator=implicit"}};
  return info;
}

}  // namespace touchmark::bench::contestants
