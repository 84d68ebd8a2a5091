# What is installed beside the libraries, and the Debian packages that `cpack` makes of it all:
#   libtouchmark-cX.Y   the shared library for C            component c
#   libtouchmark-dev    headers, static libraries, CMake    component dev
#   touchmark           the program and its workers         component program
#   touchmark-plots     pictures and pages of results       component plots
#   python3-touchmark   the module for Debian's Python      component python, installed only by its name
# scripts/packaging/debian builds and tries them.
include(GNUInstallDirs)

set(touchmark_components)
if(TOUCHMARK_BUILD_C)
  list(APPEND touchmark_components c)
endif()
list(APPEND touchmark_components dev)

if(TOUCHMARK_BUILD_BENCH)
  list(APPEND touchmark_components program plots)
  # The program finds its workers beside itself, whatever name it is called by.
  set(touchmark_programs ${CMAKE_INSTALL_LIBDIR}/touchmark)
  # touchmark_link(COMPONENT NAME TARGET): a relative link in bin, so that the whole may be moved.
  function(touchmark_link component name target)
    file(RELATIVE_PATH to ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_PREFIX}/${target})
    file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/package-documents/links)
    file(CREATE_LINK ${to} ${CMAKE_CURRENT_BINARY_DIR}/package-documents/links/${name} SYMBOLIC)
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/package-documents/links/${name} DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${component})
  endfunction()
  get_property(modules GLOBAL PROPERTY TOUCHMARK_RIVAL_MODULES)
  set(touchmark_targets touchmark touchmark-worker touchmark-worker-bullet-float touchmark-worker-plugin)
  list(TRANSFORM touchmark_targets REPLACE "(.+)" "$<TARGET_FILE:\\1>" OUTPUT_VARIABLE files)
  string(REPLACE ";" "|" files "${files}")
  set_target_properties(touchmark PROPERTIES TOUCHMARK_FILES "${files}")
  function(touchmark_install_program)
    install(TARGETS ${touchmark_targets} RUNTIME DESTINATION ${touchmark_programs} COMPONENT program)
    install(TARGETS touchmark-extra touchmark-tracer ${modules} RUNTIME DESTINATION ${touchmark_programs} COMPONENT program OPTIONAL
            LIBRARY DESTINATION ${touchmark_programs} COMPONENT program OPTIONAL)
    touchmark_link(program touchmark ${touchmark_programs}/touchmark)
  endfunction()
  touchmark_rules(program touchmark_install_program)
  set(touchmark_scripts ${CMAKE_INSTALL_DATADIR}/touchmark/scripts)
  install(PROGRAMS scripts/plot scripts/report DESTINATION ${touchmark_scripts} COMPONENT plots)
  install(DIRECTORY scripts/drawing scripts/reporting DESTINATION ${touchmark_scripts} COMPONENT plots
          PATTERN __pycache__ EXCLUDE)
  foreach(name plot report)
    touchmark_link(plots touchmark-${name} ${touchmark_scripts}/${name})
  endforeach()
endif()

if(TOUCHMARK_BUILD_PYTHON)
  list(APPEND touchmark_components python)
  set(touchmark_python_folder lib/python3/dist-packages/touchmark)
  install(TARGETS touchmark_python LIBRARY DESTINATION ${touchmark_python_folder} COMPONENT python EXCLUDE_FROM_ALL)
  install(FILES ${PROJECT_SOURCE_DIR}/python/touchmark/__init__.py ${PROJECT_SOURCE_DIR}/python/touchmark/_native.pyi
    ${PROJECT_SOURCE_DIR}/python/touchmark/py.typed DESTINATION ${touchmark_python_folder} COMPONENT python EXCLUDE_FROM_ALL)
endif()

set(TOUCHMARK_PACKAGE_CONTACT "The Touchmark authors <touchmark@example.invalid>" CACHE STRING
  "Who publishes the packages: name and address")
set(CPACK_PACKAGE_CONTACT "${TOUCHMARK_PACKAGE_CONTACT}")
set(CPACK_PACKAGE_VENDOR "The Touchmark authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each has its own
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL ${touchmark_components})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz CACHE STRING "How the packages are compressed: xz, zstd, gzip or none")

# What every Debian package has: its licence, what changed, and since when there is this revision.
set(touchmark_documents ${CMAKE_CURRENT_BINARY_DIR}/package-documents)
set(touchmark_revision ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${touchmark_documents}/changelog.Debian "touchmark (${touchmark_revision}) unstable; urgency=medium\n\n"
  "  * What has changed for users is in changelog.gz.\n\n -- ${TOUCHMARK_PACKAGE_CONTACT}  ${date}\n")
configure_file(CHANGELOG.md ${touchmark_documents}/changelog COPYONLY)
foreach(file changelog changelog.Debian)
  execute_process(COMMAND gzip -9nc ${touchmark_documents}/${file} OUTPUT_FILE ${touchmark_documents}/${file}.gz
                  COMMAND_ERROR_IS_FATAL ANY)
endforeach()

function(touchmark_install_documents component name)
  set(excluded)
  if(component STREQUAL "python")
    set(excluded EXCLUDE_FROM_ALL)
  endif()
  install(FILES ${touchmark_documents}/changelog.gz ${touchmark_documents}/changelog.Debian.gz
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component} ${excluded})
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} RENAME copyright
          COMPONENT ${component} ${excluded})
endfunction()

# touchmark_package(COMPONENT PIECE NAME SUMMARY LINES...): the first line of a description, and the others. PIECE is
# what it has documents for.
macro(touchmark_package component piece name)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  string(REPLACE ";" "\n" CPACK_COMPONENT_${upper}_DESCRIPTION "${ARGN}")
  touchmark_rules(${piece} touchmark_install_documents ${component} ${name})
endmacro()

set(touchmark_c_package libtouchmark-c${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
if(TOUCHMARK_BUILD_C)
  touchmark_package(c c ${touchmark_c_package} "exact collision detectors for haptic loops, shared library for C"
    "What programs need at run time that use touchmark/touchmark.h, in C and in" "languages that call C.")
  set(CPACK_DEBIAN_C_PACKAGE_SECTION libs)
  file(WRITE ${touchmark_documents}/triggers "activate-noawait ldconfig\n")
  set(CPACK_DEBIAN_C_PACKAGE_CONTROL_EXTRA ${touchmark_documents}/triggers)
  set(touchmark_needs_c ", ${touchmark_c_package} (= ${touchmark_revision})")
endif()
touchmark_package(dev core libtouchmark-dev "exact collision detectors for haptic loops, to build programs with"
  "Headers, static libraries, CMake package and pkg-config files of the"
  "detectors: contact, nearest triangle and sweep of a sphere against a triangle" "mesh, decided exactly.")
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev (>= 3.4)${touchmark_needs_c}")
if(TOUCHMARK_BUILD_MESH_IO)
  string(APPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS ", libassimp-dev, libdraco-dev, libpugixml-dev")
endif()
if(TOUCHMARK_BUILD_BENCH)
  touchmark_package(program program touchmark "benchmark of collision detectors for haptic loops"
    "Finds out which collision detector can serve a haptic loop: each answer is"
    "checked against an exact oracle, and all detectors are timed on the same" "motions.")
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "touchmark-plots, glmark2-data")
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "libtouchmark-dev, valgrind")
  touchmark_package(plots plots touchmark-plots "pictures and pages of Touchmark's results"
    "The commands touchmark-plot and touchmark-report, which draw what the program" "touchmark has measured.")
  set(CPACK_DEBIAN_PLOTS_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PLOTS_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_PLOTS_PACKAGE_DEPENDS
    "python3, python3-matplotlib, python3-numpy, esbuild, libjs-three, libjs-dygraphs")
endif()
if(TOUCHMARK_BUILD_PYTHON)
  touchmark_package(python python python3-touchmark "exact collision detectors for haptic loops, module for Python"
    "Closest points, contacts and sweeps of a sphere against a triangle mesh, asked" "one by one or as arrays of numpy.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  foreach(script "postinst;py3compile" "prerm;py3clean")
    list(POP_FRONT script name)
    file(WRITE ${touchmark_documents}/${name} "#!/bin/sh\nset -e\n${script} -p python3-touchmark\n")
    list(APPEND CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${touchmark_documents}/${name})
  endforeach()
  math(EXPR next "${touchmark_python_minor} + 1")  # the native part is for one version of Python
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${touchmark_python_minor}), python3 (<< 3.${next}), python3-numpy")
endif()
file(WRITE ${touchmark_documents}/project_config.cmake "set(ENV{TOUCHMARK_INSTALLS_ALL} 1)\n")
set(CPACK_PROJECT_CONFIG_FILE ${touchmark_documents}/project_config.cmake)
include(CPack)
