/// What runs a plug-in that is a script. CMake puts the other ends of script_plugin.cpp, python_plugin.py and
/// javascript_plugin.js, into the program.
#pragma once

namespace touchmark::bench::contestants {

struct Interpreter {
  const char* language;
  const char* name;     ///< as messages call the process
  const char* command;  ///< the first in PATH runs
  const char* option;   ///< after which the command takes a program
  const char* program;  ///< its arguments are the script's path and the number of the channel's descriptor
  const char* way_out;  ///< what to type if there is no such command
};

extern const Interpreter python, javascript;

}  // namespace touchmark::bench::contestants
