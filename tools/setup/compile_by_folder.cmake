# The sources of a folder are compiled together, as one unit, because most of the compiler's time goes to headers that
# neighbours share. Two sources of one folder therefore cannot give two things one name, not even in unnamed namespaces.
# Sources that Highway includes again for each SIMD target stay units of their own.
function(strata_compile_by_folder target)
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    file(STRINGS ${source} for_simd_targets REGEX "hwy/foreach_target\\.h" LIMIT_COUNT 1)
    if(for_simd_targets)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    else()
      cmake_path(GET source PARENT_PATH folder)
      cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
      string(REPLACE "/" "_" folder ${folder})
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder})
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()
