#include "bench/regression/driver/plugin_library.h"

#include <array>
#include <stdexcept>

#include <dlfcn.h>

namespace touchmark::bench::regression::driver {
namespace {

template <class Function>
void find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(::dlsym(library, name));
  if (function == nullptr) throw std::invalid_argument(std::string("not a plug-in: ") + ::dlerror());
}

}  // namespace

PluginLibrary::PluginLibrary(const std::string& path) {
  // A path without a slash would be looked for among the system's libraries.
  const std::string where = path.find('/') == std::string::npos ? "./" + path : path;
  void* const library = ::dlopen(where.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw std::invalid_argument(std::string("cannot load plug-in ") + ::dlerror());
  find(library, "touchmark_gate_build", build_);
  find(library, "touchmark_gate_answer", answer_);
  find(library, "touchmark_gate_replay", replay_);
  find(library, "touchmark_gate_destroy", destroy_);
}

PluginLibrary::Detector PluginLibrary::build(const std::string& name, const TouchmarkGateMesh& mesh) const {
  std::array<char, 500> error = {};
  Detector detector(build_(name.c_str(), &mesh, error.data(), error.size()), Destroy{destroy_});
  if (!detector) throw std::runtime_error(error.data());
  return detector;
}

TouchmarkGateResult PluginLibrary::answer(const Detector& detector, const TouchmarkGatePass& pass) const {
  TouchmarkGateResult result = {};
  answer_(detector.get(), &pass, &result);
  return result;
}

TouchmarkGateResult PluginLibrary::replay(const Detector& detector, const TouchmarkGatePass& pass) const {
  TouchmarkGateResult result = {};
  replay_(detector.get(), &pass, &result);
  return result;
}

}  // namespace touchmark::bench::regression::driver
