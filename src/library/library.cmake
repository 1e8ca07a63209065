# What a foreign project gets: Strata::strata and Strata::noise, static, by find_package(Strata). Install components:
#   noise     Strata::noise and its header, for those who take nothing else
#   strata    Strata::strata and its header; needs noise
#   program   the strata program
strata_floor(strata_noise_library src/library/noise strata_noise)
strata_floor(strata_library src/library strata_noise_library strata_render strata_image)
set_target_properties(strata_library PROPERTIES STRATA_LIGHT ON)
if(STRATA_SANITIZE)
  return()
endif()

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Strata)

# One archive of the objects of several floors, so that neither floors nor their options are exported.
function(strata_archive name header)
  list(TRANSFORM ARGN REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>" OUTPUT_VARIABLE objects)
  add_library(strata_${name}_archive STATIC ${objects})
  set_target_properties(strata_${name}_archive PROPERTIES
    LINKER_LANGUAGE CXX EXPORT_NAME ${name} ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/library)
  target_compile_features(strata_${name}_archive INTERFACE cxx_std_20)
  install(TARGETS strata_${name}_archive EXPORT Strata_${name}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${name}
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(FILES ${PROJECT_SOURCE_DIR}/src/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/strata COMPONENT ${name})
  install(EXPORT Strata_${name} NAMESPACE Strata:: DESTINATION ${package_folder} COMPONENT ${name})
endfunction()

strata_archive(noise noise.h strata_noise strata_noise_library)
set_target_properties(strata_noise_archive PROPERTIES OUTPUT_NAME strata_noise)
target_link_libraries(strata_noise_archive PRIVATE PkgConfig::hwy)

strata_archive(strata strata.h strata_filter strata_sample strata_solid strata_scene strata_daylight strata_shaders strata_trace
  strata_accel strata_integrate strata_parallel strata_film strata_estimate strata_render strata_image strata_library)
set_target_properties(strata_strata_archive PROPERTIES OUTPUT_NAME strata)
target_link_libraries(strata_strata_archive PUBLIC strata_noise_archive
  PRIVATE PkgConfig::hwy TBB::tbb PkgConfig::OpenImageIO PkgConfig::freetype2 fmt::fmt
  tomlplusplus::tomlplusplus ZLIB::ZLIB)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/StrataConfig.cmake.in
  ${PROJECT_BINARY_DIR}/library/StrataConfig.cmake INSTALL_DESTINATION ${package_folder})
# Before 1.0 the interface may change with the second number.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/library/StrataConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_SOURCE_DIR}/src/error.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/strata COMPONENT noise)
install(FILES ${PROJECT_BINARY_DIR}/library/StrataConfig.cmake ${PROJECT_BINARY_DIR}/library/StrataConfigVersion.cmake
  DESTINATION ${package_folder} COMPONENT noise)
