#include "core/named/detector_options.h"

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

Option certified_option(bool& certified) {
  return choice<bool>("certified", certified, {{"true", true}, {"false", false}},
                      "false: contact as doubles have it, to measure what certainty costs")
      .in_code("certified");
}

template <class Construction>
Option build_option(Construction& construction, const std::string& type, const char* summary) {
  return choice<Construction>("build", construction,
                              {{"whole", Construction::whole}, {"lazy", Construction::lazy}}, summary)
      .in_code("construction", type);
}

}  // namespace

PublishedGridGroup::Options GridGroupForm::published_options() const {
  GridGroup::check(fast);
  expect_published(fast, "grid-group", "lookup=direct, not for scan");
  return {published.shape, fast.cell, published.groups};
}

PublishedSphereCluster::Options SphereClusterForm::published_options() const {
  expect_published(fast, "sphere-cluster", "lookup=tree with precise=true");
  return {fast.clustering, published.precise};
}

Option side_option(bool& side) {
  return choice<bool>("side", side, {{"off", false}, {"on", true}}, "on: contacts tell inside from outside");
}

Option threads_option(unsigned& threads) {
  return count("threads", threads,
               "threads that build it, 256 at most; 0: one a processor; the same bits with any number")
      .in_code("threads");
}

std::vector<Option> options_of(BruteForce::Options&) { return {}; }

std::vector<Option> options_of(AabbTree::Options& options) {
  return {count("leaf_size", options.leaf_size, "triangles a leaf holds at most").in_code("leaf_size"),
          certified_option(options.certified), threads_option(options.threads)};
}

std::vector<Option> options_of(GridGroupForm& form) {
  using Shape = PublishedGridGroup::Shape;
  return {choice<bool>("lookup", form.is_published, {{"direct", false}, {"scan", true}},
                       "direct: the probe's own cell; scan: every group, as published"),
          choice<Shape>(
              "shape", form.published.shape,
              {{"cube", Shape::cube}, {"sphere", Shape::sphere}, {"centered-sphere", Shape::centered_sphere}},
              "of the groups; scan only; sphere: the smallest; centered-sphere: about the cuboid's centre")
              .in_code("shape", "PublishedGridGroup::Shape"),
          length("cell", form.fast.cell,
                 "edge of a cell, direct: of the smallest; larger where memory is short; 0: choose")
              .in_code("cell"),
          count("groups", form.published.groups, "scan with cell=0: aim at so many groups; 0: choose")
              .in_code("groups"),
          number("bytes_per_triangle", form.fast.bytes_per_triangle, "direct: what the structure may take")
              .in_code("bytes_per_triangle"),
          certified_option(form.fast.certified),
          build_option(form.fast.construction, "GridGroup::Construction",
                       "lazy: groups and cells are made by the first queries that want them"),
          threads_option(form.fast.threads)};
}

std::vector<Option> options_of(SphereClusterForm& form) {
  return {
      choice<bool>("lookup", form.scans, {{"tree", false}, {"scan", true}},
                   "tree: a hierarchy, nearest first; scan: every sphere, as published"),
      length("clustering", form.fast.clustering,
             "distance between centroids that share a sphere; 0: a sphere each")
          .in_code("clustering"),
      choice<bool>("precise", form.published.precise, {{"true", true}, {"false", false}},
                   "false: the published fast level alone, spheres for triangles")
          .in_code("precise"),
      certified_option(form.fast.certified),
      build_option(
          form.fast.construction, "SphereCluster::Construction",
          "tree; lazy: parts of it are built, and distances sampled, by the first queries that want them"),
      choice<Simd>("simd", form.fast.widest,
                   {{"avx2", Simd::avx2}, {"avx512", Simd::avx2}, {"portable", Simd::portable}},
                   "tree: no wider instructions than these, nor than the processor's; avx512 is avx2")
          .in_code("widest", "Simd"),
      threads_option(form.fast.threads)};
}

}  // namespace touchmark::named
