# Every library that the chosen parts stand on; the Debian packages are listed in packages-planner.txt
# and, for the other parts, in packages.txt. nbvoptConfig.cmake.in looks for the same ones.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(octomap 1.9 REQUIRED CONFIG)
find_package(hwy 1.0 REQUIRED CONFIG)
find_package(TBB REQUIRED CONFIG)
find_package(yaml-cpp REQUIRED CONFIG)
find_package(PNG 1.6 REQUIRED)
find_package(ZLIB 1.2 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED CONFIG)
# Debian's C++ build of NLopt, which has StoGO and AGS; the plain one throws when asked for them.
find_package(NLopt 2.7 REQUIRED PATHS /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/nlopt_cxx NO_DEFAULT_PATH)
find_package(Ceres 2.1 REQUIRED CONFIG)
find_package(urdfdom REQUIRED CONFIG)
# The simulator's: worlds, meshes, rays.
if(NBVOPT_BUILD_SIM)
  find_package(embree 3.13 REQUIRED CONFIG)
  find_package(tinyxml2 9.0 REQUIRED CONFIG)
  find_package(assimp 5.2 REQUIRED CONFIG)
endif()
# The server's and its clients'.
if(NBVOPT_BUILD_SERVER)
  find_package(Protobuf 3.21 REQUIRED)
  find_package(gRPC 1.51 REQUIRED CONFIG)
  find_package(spdlog 1.10 REQUIRED CONFIG)
endif()
# The Python module's: Debian's own Python, whichever else stands before it on the PATH.
if(NBVOPT_BUILD_PYTHON)
  if(NOT DEFINED Python_EXECUTABLE)
    set(Python_EXECUTABLE /usr/bin/python3)
  endif()
  find_package(Python REQUIRED COMPONENTS Interpreter Development.Module)
  find_package(pybind11 2.10 REQUIRED CONFIG)
endif()
# The command line's.
if(NBVOPT_BUILD_CLI)
  find_package(CLI11 2.1 REQUIRED CONFIG)
endif()
