#include "bench/contestants/plain_scenes.h"

namespace touchmark::bench::contestants {

ContestantInfo looped_entry() {
  return plain_scene_entry<LoopedScene>(
      "looped", 44, "every body of a scene asked in turn: a plain loop over one of our detectors");
}

}  // namespace touchmark::bench::contestants
