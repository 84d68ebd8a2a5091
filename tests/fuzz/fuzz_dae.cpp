#include "core/mesh_io/dae/read_dae.h"
#include "tests/fuzz/graph_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return touchmark::fuzz::read_as_graph(touchmark::mesh_io::read_dae, data, size);
}
