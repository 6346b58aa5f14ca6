# What `cmake --install` puts in place: the libraries with headers and package config (the component
# dev), the tool (tool), the Python module (python), the ROS node (ros). A component is a Debian
# package.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/nbvopt)

# nbvopt_install_licence(<component> <package>): where Debian looks for it.
function(nbvopt_install_licence component package)
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} RENAME copyright
    COMPONENT ${component})
endfunction()

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME dev)
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

nbvopt_install_licence(dev libnbvopt-dev)

if(TARGET nbvopt_cli)
  set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME tool)
  install(TARGETS nbvopt_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(DIRECTORY ${nbvopt_description}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR})
  install(FILES ${nbvopt_description}/nbvopt
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${nbvopt_description}/_nbvopt
    DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
  install(FILES datasets/office_partial.ot datasets/office.world
    DESTINATION ${CMAKE_INSTALL_DATADIR}/nbvopt/datasets)
  install(DIRECTORY datasets/robots DESTINATION ${CMAKE_INSTALL_DATADIR}/nbvopt/datasets)
  nbvopt_install_licence(tool nbvopt)
  if(NBVOPT_BUILD_SERVER)
    configure_file(packaging/nbvopt.service.in nbvopt.service @ONLY)
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/nbvopt.service DESTINATION lib/systemd/system)
  endif()
endif()
if(NBVOPT_BUILD_PYTHON)
  nbvopt_install_licence(python python3-nbvopt)
endif()
if(NBVOPT_BUILD_ROS)
  nbvopt_install_licence(ros nbvopt-ros)
endif()
