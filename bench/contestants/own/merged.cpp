#include "bench/contestants/plain_scenes.h"

namespace touchmark::bench::contestants {

ContestantInfo merged_entry() {
  return plain_scene_entry<MergedScene>(
      "merged", 45,
      "all triangles of a scene as one mesh, which one of our detectors is built of; bodies stand");
}

}  // namespace touchmark::bench::contestants
