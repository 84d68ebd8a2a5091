#include "bench/regression/driver/plugin_library.h"

#include <array>
#include <filesystem>
#include <stdexcept>

#if defined(_WIN32)
#include <windows.h>
#else
#include <dlfcn.h>
#endif

namespace touchmark::bench::regression::driver {
namespace {

#if defined(_WIN32)
HMODULE load(const std::filesystem::path& path) { return ::LoadLibraryW(path.c_str()); }
void* symbol(HMODULE from, const char* name) { return reinterpret_cast<void*>(::GetProcAddress(from, name)); }
std::string last_error() { return "error " + std::to_string(::GetLastError()); }
#else
void* load(const std::filesystem::path& path) { return ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL); }
void* symbol(void* from, const char* name) { return ::dlsym(from, name); }
std::string last_error() { return ::dlerror(); }
#endif

template <class Library, class Function>
void find(Library library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(symbol(library, name));
  if (function == nullptr) throw std::invalid_argument("not a plug-in: " + last_error());
}

}  // namespace

PluginLibrary::PluginLibrary(const std::string& path) {
  // A path without a slash would be looked for among the system's libraries.
  const auto library = load(std::filesystem::absolute(path).make_preferred());
  if (library == nullptr) throw std::invalid_argument("cannot load plug-in " + path + ": " + last_error());
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
