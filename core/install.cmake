# Headers are included as core/... here and as touchmark/... by users: #include <touchmark/grid_group.h>. With
# TOUCHMARK_INSTALL, touchmark::core, and the other libraries where they are built, are installed for
# find_package and for pkg-config.
include(installed_headers.cmake)
set(touchmark_include ${CMAKE_CURRENT_BINARY_DIR}/include)

# touchmark_install(NAME): the target touchmark_NAME, its headers found and, where wanted, installed.
function(touchmark_install name)
  if(PROJECT_IS_TOP_LEVEL OR TOUCHMARK_BUILD_BENCH OR TOUCHMARK_BUILD_TESTS)
    target_include_directories(touchmark_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  else()
    target_include_directories(touchmark_${name} PRIVATE ${PROJECT_SOURCE_DIR}
                               INTERFACE $<BUILD_INTERFACE:${touchmark_include}>)
  endif()
  if(TOUCHMARK_INSTALL)
    touchmark_rules(${name} touchmark_install_${name})
  endif()
endfunction()

# What a plug-in is built with: touchmark/contestant.h, in C or any language that reads it.
add_library(touchmark_contestant INTERFACE)
add_library(touchmark::contestant ALIAS touchmark_contestant)
set_target_properties(touchmark_contestant PROPERTIES EXPORT_NAME contestant)
target_include_directories(touchmark_contestant INTERFACE $<BUILD_INTERFACE:${touchmark_include}>)

if(NOT PROJECT_IS_TOP_LEVEL)
  touchmark_write_headers(${CMAKE_CURRENT_SOURCE_DIR} ${touchmark_include} ${touchmark_public_headers})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${touchmark_written_headers})
endif()
if(NOT TOUCHMARK_INSTALL)
  return()
endif()

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(touchmark_package ${CMAKE_INSTALL_LIBDIR}/cmake/touchmark)
set(touchmark_core_folder ${CMAKE_CURRENT_SOURCE_DIR})

# An export file for each library, so that who wants the core alone need not have what the rest depends on.
function(touchmark_install_library name)
  install(TARGETS touchmark_${name} ${ARGN} EXPORT touchmark-${name}
          ARCHIVE COMPONENT dev
          LIBRARY COMPONENT ${name} NAMELINK_COMPONENT dev
          RUNTIME COMPONENT ${name}
          INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT touchmark-${name} NAMESPACE touchmark:: DESTINATION ${touchmark_package} COMPONENT dev)
endfunction()

# From where a .pc file lies back to the prefix, so that the whole may be moved.
file(RELATIVE_PATH touchmark_pc_to_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
# Empty where the C library has threads itself.
set(touchmark_thread_library)
if(CMAKE_THREAD_LIBS_INIT)
  set(touchmark_thread_library " ${CMAKE_THREAD_LIBS_INIT}")
endif()
function(touchmark_install_pc file)
  configure_file(${touchmark_core_folder}/${file}.in ${file} @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${file} DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
endfunction()

function(touchmark_install_core)
  touchmark_install_library(core touchmark_contestant)
  touchmark_install_pc(touchmark.pc)
  # Written when they are installed, so that they are those of the tree as it is then, and of what is built. The folder of a
  # header is the piece that it belongs to where that may be left out.
  install(CODE "include(\"${touchmark_core_folder}/installed_headers.cmake\")
set(headers ${touchmark_public_headers})
foreach(piece IN LISTS touchmark_unbuilt)
  list(FILTER headers EXCLUDE REGEX \"^\${piece}/\")
endforeach()
touchmark_write_headers(\"${touchmark_core_folder}\" \"${touchmark_include}\" \${headers})" COMPONENT dev)
  install(DIRECTORY ${touchmark_include}/touchmark DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)

  configure_package_config_file(${touchmark_core_folder}/touchmark-config.cmake.in touchmark-config.cmake
                                INSTALL_DESTINATION ${touchmark_package})
  write_basic_package_version_file(touchmark-config-version.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/touchmark-config.cmake
                ${CMAKE_CURRENT_BINARY_DIR}/touchmark-config-version.cmake
          DESTINATION ${touchmark_package} COMPONENT dev)
endfunction()

function(touchmark_install_mesh_io)
  touchmark_install_library(mesh_io)
endfunction()

function(touchmark_install_mesh_io_assimp)
  touchmark_install_library(mesh_io_assimp)
endfunction()

function(touchmark_install_c)
  touchmark_install_library(c)
  touchmark_install_pc(touchmark-c.pc)
endfunction()
