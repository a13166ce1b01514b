# The installed package: find_package(rangezip CONFIG [COMPONENTS core raster_cpu ...]).
include(CMakePackageConfigHelpers)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/rangezipConfig.cmake.in
  ${PROJECT_BINARY_DIR}/rangezipConfig.cmake INSTALL_DESTINATION ${RANGEZIP_PACKAGE_DIR})
# Before 1.0 every minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/rangezipConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/rangezipConfig.cmake
  ${PROJECT_BINARY_DIR}/rangezipConfigVersion.cmake
  DESTINATION ${RANGEZIP_PACKAGE_DIR})
