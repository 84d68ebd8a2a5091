/// What runs in the interpreter: bench/contestants/plugins/python_plugin.py, put into the program by CMake.
#pragma once

namespace touchmark::bench::contestants {

extern const char* const python_script;

}  // namespace touchmark::bench::contestants
