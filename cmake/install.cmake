# What `cmake --install` puts in place: the libraries, their headers, the package config, the tool.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/nbvopt)

install(TARGETS nbvopt EXPORT nbvoptTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT nbvoptTargets NAMESPACE nbvopt:: DESTINATION ${package_dir})
# A component of its own: who only plans needs none of the simulator's libraries.
if(NBVOPT_BUILD_SIM)
  install(TARGETS nbvopt_sim EXPORT nbvoptSimTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT nbvoptSimTargets NAMESPACE nbvopt:: DESTINATION ${package_dir})
endif()
# The same for who calls a planning server.
if(NBVOPT_BUILD_SERVER)
  install(TARGETS nbvopt_client nbvopt_protocol nbvopt_protocol_generated EXPORT nbvoptClientTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT nbvoptClientTargets NAMESPACE nbvopt:: DESTINATION ${package_dir})
  install(FILES ${nbvopt_proto} DESTINATION ${CMAKE_INSTALL_DATADIR}/nbvopt/proto/nbvopt/v1)
endif()
install(DIRECTORY include/nbvopt DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

configure_package_config_file(cmake/nbvoptConfig.cmake.in nbvoptConfig.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(nbvoptConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/nbvoptConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/nbvoptConfigVersion.cmake
  DESTINATION ${package_dir})

install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(TARGET nbvopt_cli)
  install(TARGETS nbvopt_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
