# 64-bit Windows, by Debian's MinGW-w64. Programs and DLLs hold GCC's libraries, so that they run without them.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR AMD64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
add_link_options(-static)
