# Installs touchmark::core, and touchmark::mesh_io where it is built, for find_package and for pkg-config. Headers
# go to include/touchmark/core/..., and are included from there as here: #include <core/probe.h>
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(touchmark_package ${CMAKE_INSTALL_LIBDIR}/cmake/touchmark)

# touchmark_install(NAME): the target touchmark_NAME, with an export file of its own, so that who wants the core
# alone need not have what the rest depends on.
function(touchmark_install name)
  install(TARGETS touchmark_${name} EXPORT touchmark-${name}
          FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/touchmark)
  install(EXPORT touchmark-${name} NAMESPACE touchmark:: DESTINATION ${touchmark_package})
endfunction()

touchmark_install(core)

configure_package_config_file(touchmark-config.cmake.in touchmark-config.cmake
                              INSTALL_DESTINATION ${touchmark_package})
write_basic_package_version_file(touchmark-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/touchmark-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/touchmark-config-version.cmake
        DESTINATION ${touchmark_package})

# From where the .pc file lies back to the prefix, so that the whole may be moved.
file(RELATIVE_PATH touchmark_pc_to_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
configure_file(touchmark.pc.in touchmark.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/touchmark.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
