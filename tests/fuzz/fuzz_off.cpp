#include "core/mesh_io/readers.h"
#include "tests/fuzz/reader_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return touchmark::fuzz::read_as_mesh(touchmark::mesh_io::read_off, data, size);
}
