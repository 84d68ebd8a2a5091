# This machine, by clang.
set(CMAKE_CXX_COMPILER clang++)
