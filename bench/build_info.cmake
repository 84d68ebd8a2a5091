# Writes what bench/results/build_info.cpp reports: configuration.h now, commit.h at every build.
string(TOUPPER "CMAKE_CXX_FLAGS_${CMAKE_BUILD_TYPE}" flags_of_type)
get_target_property(project_flags touchmark_flags INTERFACE_COMPILE_OPTIONS)
list(FILTER project_flags EXCLUDE REGEX "^\\$<|^-W")
string(JOIN " " TOUCHMARK_ALL_FLAGS -std=c++20 ${CMAKE_CXX_FLAGS} ${${flags_of_type}} ${project_flags})
if(TOUCHMARK_NATIVE)
  string(APPEND TOUCHMARK_ALL_FLAGS " -march=native")
  set(TOUCHMARK_NATIVE_01 1)
else()
  set(TOUCHMARK_NATIVE_01 0)
endif()

set(TOUCHMARK_VERSIONS_FOUND "{\"eigen\", \"${Eigen3_VERSION}\"}, {\"fmt\", \"${fmt_VERSION}\"}, {\"benchmark\", \"${benchmark_VERSION}\"}, {\"cli11\", \"${CLI11_VERSION}\"}, {\"nlohmann-json\", \"${nlohmann_json_VERSION}\"}")
find_program(PKG_CONFIG pkg-config)
foreach(library gmp assimp pugixml fcl ccd bullet bullet-float64)
  set(library_version)
  if(PKG_CONFIG)
    execute_process(COMMAND ${PKG_CONFIG} --modversion ${library} OUTPUT_VARIABLE library_version
                    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  endif()
  if(library_version)
    string(APPEND TOUCHMARK_VERSIONS_FOUND ", {\"${library}\", \"${library_version}\"}")
  endif()
endforeach()

get_property(rival_versions GLOBAL PROPERTY TOUCHMARK_RIVAL_VERSIONS)
foreach(version IN LISTS rival_versions)
  string(APPEND TOUCHMARK_VERSIONS_FOUND ", ${version}")
endforeach()

set(generated ${CMAKE_CURRENT_BINARY_DIR}/include/bench/generated)
configure_file(configuration.h.in ${generated}/configuration.h @ONLY)
add_custom_target(touchmark_commit
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DOUTPUT=${generated}/commit.h -P ${CMAKE_CURRENT_SOURCE_DIR}/write_commit.cmake
  BYPRODUCTS ${generated}/commit.h)
