# touchmark_unite_folders(TARGET CORE): each folder of CORE, which is core or a copy of it, is compiled as one source of
# TARGET, in half the time; so are the folders below core/search.
function(touchmark_unite_folders target core)
  # Compiled by themselves: neighborhood and linear_scan since slides take fewer instructions then, the others since their
  # unnamed namespaces name things as another file's of the folder do.
  set(alone exact/precise_closest_point geometry/path_gap grid_group/grid_group point_queries/nearest
    point_queries/neighborhood point_queries/touch search/linear_scan search/ties/nearest_of_ties search/ties/same_location)
  # Compiled with each other, since their unnamed namespaces name things as another file's of their own folder do.
  set(apart bvh/build/bounding_cylinder field/plane_fitter scene/near_surface scene/pose scene/pose_change scene/round/primitives
    scene/round/round_body scene/round/support_table scene/scene_bodies scene/seen_body scene/surface_list search/many/curve_order)
  foreach(name IN LISTS alone apart)
    if(NOT EXISTS ${PROJECT_SOURCE_DIR}/core/${name}.cpp)
      message(FATAL_ERROR "touchmark_unite_folders: there is no core/${name}.cpp")
    endif()
  endforeach()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${core} OUTPUT_VARIABLE name)
    cmake_path(RELATIVE_PATH name BASE_DIRECTORY ${core})
    cmake_path(GET name PARENT_PATH folder)
    cmake_path(REMOVE_EXTENSION name)
    if(EXISTS ${core}/${name}.cpp AND NOT folder MATCHES "^\\.\\." AND NOT name IN_LIST alone)
      if(name IN_LIST apart)
        set(folder apart)
      endif()
      string(REGEX REPLACE "^search/.*" "search" folder "${folder}")
      string(REPLACE "/" "_" folder "${folder}")
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP core_${folder})
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${TOUCHMARK_UNITY} UNITY_BUILD_MODE GROUP)
endfunction()
