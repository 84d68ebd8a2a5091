/// A rival whose library takes long to load: its detector is in a shared object of its own beside the
/// program, which is loaded by the first who builds it. All others start as fast as without it.
#pragma once

#include <memory>
#include <string>

#include "bench/contestants/contestant.h"
#include "bench/contestants/contestant_info.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::contestants {

/// Loads the rival's shared object, unless it is there, and returns its function that builds a contestant.
/// Throws std::runtime_error where it cannot be loaded.
void* builder_of(const std::string& rival);

/// Has the shared object loaded before the first build. Where there is none the rival is not built.
void comes_from_module(ContestantInfo& info, const std::string& rival);

/// Builds the rival by the options of its detector. Throws what builder_of and the detector's build throw.
template <class Options>
std::unique_ptr<Contestant> contestant_of_module(const std::string& rival, const TriangleMesh& mesh,
                                                 const Options& options) {
  using Build = std::unique_ptr<Contestant>(const TriangleMesh&, const Options&);
  return reinterpret_cast<Build*>(builder_of(rival))(mesh, options);
}

}  // namespace touchmark::bench::contestants
