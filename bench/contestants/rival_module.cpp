#include "bench/contestants/rival_module.h"

#include <filesystem>
#include <stdexcept>

#include <dlfcn.h>

#include "bench/support/system/beside_this_program.h"

namespace touchmark::bench::contestants {

namespace {

std::filesystem::path module_of(const std::string& rival) {
  return support::beside_this_program("touchmark-" + rival + ".so");
}

}  // namespace

/// The shared object stays in the process until it ends.
void* builder_of(const std::string& rival) {
  const std::filesystem::path path = module_of(rival);
  void* const object = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const function = object == nullptr ? nullptr : dlsym(object, "touchmark_build");
  if (function == nullptr) {
    const char* const why = dlerror();
    throw std::runtime_error(rival + " cannot be loaded: " + (why == nullptr ? "no reason is given" : why));
  }
  return function;
}

void comes_from_module(ContestantInfo& info, const std::string& rival) {
  info.load = [rival] { builder_of(rival); };
  if (!std::filesystem::exists(module_of(rival))) info.build = {};
}

}  // namespace touchmark::bench::contestants
