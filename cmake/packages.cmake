# The Debian packages that `make deb` builds, one a component of cmake/install.cmake. Libraries are
# static, so that there is no package between the tool and what programs are built with.
set(scripts ${PROJECT_SOURCE_DIR}/packaging)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "nbvopt authors")
set(CPACK_PACKAGE_CONTACT "nbvopt authors <nbvopt@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 2)
set(CPACK_COMPONENTS_ALL dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # which libraries a program needs, from the program
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libnbvopt-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEV_DESCRIPTION "The C++ library: static libraries, headers and a CMake package, \
whose components sim and client need what is recommended.")
# As packages-planner.txt and packages.txt have them; those that headers alone need are built in.
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev, liboctomap-dev, libhwy-dev, libtbb-dev, \
libyaml-cpp-dev, libpng-dev, zlib1g-dev, liburdfdom-dev, libnlopt-cxx-dev, libceres-dev")
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "libembree-dev, libtinyxml2-dev, libassimp-dev, \
libgrpc++-dev, libprotobuf-dev, protobuf-compiler, protobuf-compiler-grpc")

if(NBVOPT_BUILD_CLI)
  list(APPEND CPACK_COMPONENTS_ALL tool)
  set(CPACK_DEBIAN_TOOL_PACKAGE_NAME nbvopt)
  set(CPACK_DEBIAN_TOOL_PACKAGE_SECTION science)
  set(CPACK_COMPONENT_TOOL_DESCRIPTION "The command line tool: queries on maps, a planning server, \
a simulator, and studies of searches.")
  if(NBVOPT_BUILD_SERVER)
    set(CPACK_DEBIAN_TOOL_PACKAGE_CONTROL_EXTRA
      ${scripts}/tool/postinst ${scripts}/tool/prerm ${scripts}/tool/postrm)
  endif()
endif()

if(NBVOPT_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-nbvopt)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
    ${scripts}/python_modules/postinst ${scripts}/python_modules/prerm)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "The Python module: maps, planner and simulator, and a client \
of the planning server, which needs what is recommended.")
  # The module is built for one version of Python.
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), \
python3 (<< ${Python_VERSION_MAJOR}.${next_minor}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-grpcio, python3-protobuf")
endif()

if(NBVOPT_BUILD_ROS)
  list(APPEND CPACK_COMPONENTS_ALL ros)
  set(CPACK_DEBIAN_ROS_PACKAGE_NAME nbvopt-ros)
  set(CPACK_DEBIAN_ROS_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_ROS_PACKAGE_CONTROL_EXTRA
    ${scripts}/python_modules/postinst ${scripts}/python_modules/prerm)
  set(CPACK_COMPONENT_ROS_DESCRIPTION "The ROS 1 node that keeps a map and moves the camera, a simulated \
robot for it, launch files, and the interfaces for rospy and rosservice.")
  # The launch files', and what the interfaces' modules import.
  set(CPACK_DEBIAN_ROS_PACKAGE_DEPENDS "python3-roslaunch, python3-genpy, python3-geometry-msgs, \
python3-std-msgs")
  set(CPACK_DEBIAN_ROS_PACKAGE_RECOMMENDS "python3-rosservice, nbvopt")  # the latter plans drives
  set(CPACK_DEBIAN_ROS_PACKAGE_SUGGESTS rviz)
endif()

include(CPack)
