#include "core/mesh_io/gltf/read_gltf.h"
#include "tests/fuzz/graph_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // Side files are looked for where there are none.
  const auto read = [](std::string_view bytes) {
    return touchmark::mesh_io::read_gltf(bytes, "/nonexistent");
  };
  return touchmark::fuzz::read_as_graph(read, data, size);
}
