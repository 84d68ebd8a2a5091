#include "core/named/published_form.h"

#include <stdexcept>
#include <string>

#include "core/search/threads/parallel.h"

namespace touchmark::named {
namespace {

/// `form` names the words that choose the fast form.
template <class Options>
void expect_published(const Options& options, const std::string& detector, const std::string& form) {
  if (!options.certified) throw std::invalid_argument(detector + ": certified=false is for " + form);
  if (options.construction == decltype(options.construction)::lazy)
    throw std::invalid_argument(detector + ": build=lazy is for " + form);
  threads_to_use(options.threads, detector.c_str());
}

}  // namespace

void expect_published(const GridGroup::Options& options) {
  GridGroup::check(options);
  expect_published(options, "grid-group", "lookup=direct, not for scan");
}

void expect_published(const SphereCluster::Options& options) {
  expect_published(options, "sphere-cluster", "lookup=tree with precise=true");
}

}  // namespace touchmark::named
