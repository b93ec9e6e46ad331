# What a host application builds against: `find_package(stillframe)`, targets stillframe::viewer, stillframe::nodes, ...
#
# Included after all rooms. Third-party libraries are found by the same list as here, which is installed too.
include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/stillframe")

get_property(libraries GLOBAL PROPERTY STILLFRAME_PACKAGE_LIBRARIES)
list(APPEND libraries stillframe_options stillframe_draco)
if(STILLFRAME_GL)
  list(APPEND libraries stillframe_osg)
endif()
foreach(library IN LISTS libraries)
  string(REGEX REPLACE "^stillframe_" "" name "${library}")
  set_target_properties(${library} PROPERTIES EXPORT_NAME "${name}")
endforeach()
install(TARGETS ${libraries} EXPORT stillframeTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}/stillframe")
install(EXPORT stillframeTargets NAMESPACE stillframe:: DESTINATION "${package_dir}")

set(rooms tf scenegraph nodes)
if(STILLFRAME_GL AND STILLFRAME_QT)
  list(APPEND rooms viewer)
endif()
install(DIRECTORY ${rooms} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/stillframe" FILES_MATCHING PATTERN "*.h")
install(DIRECTORY tools/ingest DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/stillframe/tools" FILES_MATCHING PATTERN "*.h")

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/stillframeConfig.cmake.in" "${CMAKE_BINARY_DIR}/stillframeConfig.cmake"
                              INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${CMAKE_BINARY_DIR}/stillframeConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/stillframeConfig.cmake" "${CMAKE_BINARY_DIR}/stillframeConfigVersion.cmake"
              "${CMAKE_CURRENT_LIST_DIR}/StillframeDependencies.cmake" DESTINATION "${package_dir}")
