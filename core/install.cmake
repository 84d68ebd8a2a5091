# Installs touchmark::core, and touchmark::mesh_io and touchmark::c where they are built, for find_package and for pkg-config. Headers are
# included as core/... here and as touchmark/... by users: #include <touchmark/grid_group.h>
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
include(installed_headers.cmake)

set(touchmark_package ${CMAKE_INSTALL_LIBDIR}/cmake/touchmark)
set(touchmark_include ${CMAKE_CURRENT_BINARY_DIR}/include)

# touchmark_install(NAME): the target touchmark_NAME, with an export file of its own, so that who wants the core
# alone need not have what the rest depends on.
function(touchmark_install name)
  if(PROJECT_IS_TOP_LEVEL OR TOUCHMARK_BUILD_BENCH OR TOUCHMARK_BUILD_TESTS)
    target_include_directories(touchmark_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
  else()
    target_include_directories(touchmark_${name} PRIVATE ${PROJECT_SOURCE_DIR}
                               INTERFACE $<BUILD_INTERFACE:${touchmark_include}>)
  endif()
  install(TARGETS touchmark_${name} EXPORT touchmark-${name}
          ARCHIVE COMPONENT dev
          LIBRARY COMPONENT ${name} NAMELINK_COMPONENT dev
          RUNTIME COMPONENT ${name}
          INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT touchmark-${name} NAMESPACE touchmark:: DESTINATION ${touchmark_package} COMPONENT dev)
endfunction()

touchmark_install(core)

# What a plug-in is built with: touchmark/contestant.h, in C or any language that reads it.
add_library(touchmark_contestant INTERFACE)
add_library(touchmark::contestant ALIAS touchmark_contestant)
set_target_properties(touchmark_contestant PROPERTIES EXPORT_NAME contestant)
target_include_directories(touchmark_contestant INTERFACE $<BUILD_INTERFACE:${touchmark_include}>)
install(TARGETS touchmark_contestant EXPORT touchmark-core INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

if(NOT PROJECT_IS_TOP_LEVEL)
  touchmark_write_headers(${CMAKE_CURRENT_SOURCE_DIR} ${touchmark_include} ${touchmark_public_headers})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${touchmark_written_headers})
endif()
# Written when they are installed, so that they are those of the tree as it is then.
install(CODE "include(\"${CMAKE_CURRENT_SOURCE_DIR}/installed_headers.cmake\")
touchmark_write_headers(\"${CMAKE_CURRENT_SOURCE_DIR}\" \"${touchmark_include}\" ${touchmark_public_headers})" COMPONENT dev)
install(DIRECTORY ${touchmark_include}/touchmark DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)

configure_package_config_file(touchmark-config.cmake.in touchmark-config.cmake
                              INSTALL_DESTINATION ${touchmark_package})
write_basic_package_version_file(touchmark-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/touchmark-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/touchmark-config-version.cmake
        DESTINATION ${touchmark_package} COMPONENT dev)

# From where the .pc file lies back to the prefix, so that the whole may be moved.
file(RELATIVE_PATH touchmark_pc_to_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
# Empty where the C library has threads itself.
set(touchmark_thread_library)
if(CMAKE_THREAD_LIBS_INIT)
  set(touchmark_thread_library " ${CMAKE_THREAD_LIBS_INIT}")
endif()
set(touchmark_pc touchmark.pc)
if(TOUCHMARK_BUILD_C)
  list(APPEND touchmark_pc touchmark-c.pc)
endif()
foreach(file ${touchmark_pc})
  configure_file(${file}.in ${file} @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${file} DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
endforeach()
