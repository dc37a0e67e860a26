# The library as a package: find_package(skylapse) gives skylapse::skylapse (sun, sky, cameras, colour, GL)
# and the parts it is made of.
include(CMakePackageConfigHelpers)

add_library(skylapse_library INTERFACE)
add_library(skylapse::skylapse ALIAS skylapse_library)
set_target_properties(skylapse_library PROPERTIES EXPORT_NAME skylapse)
set(parts core data astro image gpu color sky)
list(TRANSFORM parts PREPEND skylapse_ OUTPUT_VARIABLE part_targets)
target_link_libraries(skylapse_library INTERFACE ${part_targets})

install(TARGETS skylapse_library ${part_targets} EXPORT skylapseTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
foreach(part IN ITEMS core astro image gpu color sky)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/${part} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/skylapse
    FILES_MATCHING PATTERN "*.h")
endforeach()
install(EXPORT skylapseTargets NAMESPACE skylapse:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/skylapse)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/skylapseConfig.cmake.in
  ${PROJECT_BINARY_DIR}/skylapseConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/skylapse)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/skylapseConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/skylapseConfig.cmake ${PROJECT_BINARY_DIR}/skylapseConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/skylapse)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/configs DESTINATION ${CMAKE_INSTALL_DATADIR}/skylapse)
