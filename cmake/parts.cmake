# What can be left out. Planning on a robot needs the library alone, which is always built.
option(NBVOPT_BUILD_SIM "Build the simulator and pictures (Embree, TinyXML-2, Assimp, Cairo)" ${PROJECT_IS_TOP_LEVEL})
option(NBVOPT_BUILD_SERVER "Build the planning server and its clients (gRPC)" ${PROJECT_IS_TOP_LEVEL})
option(NBVOPT_BUILD_STUDY "Build studies and the paper's experiment" ${PROJECT_IS_TOP_LEVEL})
option(NBVOPT_BUILD_PYTHON "Build the Python module" ${PROJECT_IS_TOP_LEVEL})
option(NBVOPT_BUILD_CLI "Build the command line tool" ${PROJECT_IS_TOP_LEVEL})
if(PROJECT_IS_TOP_LEVEL)
  set(ros_default AUTO)
else()
  set(ros_default OFF)
endif()
set(NBVOPT_BUILD_ROS ${ros_default} CACHE STRING
  "Build the ROS node: ON, OFF, or AUTO, where roscpp is installed (packages-ros.txt)")
option(NBVOPT_BUILD_TESTS "Build the tests and the generators of datasets" ${PROJECT_IS_TOP_LEVEL})
option(NBVOPT_BUILD_BENCHMARKS "Build the benchmarks" ${PROJECT_IS_TOP_LEVEL})
option(NBVOPT_BUILD_FUZZERS "Build the libFuzzer targets (clang only)" OFF)

# nbvopt_part_needs(<part> <parts>...): a part that is on needs these to be on, too.
function(nbvopt_part_needs part)
  foreach(needed ${ARGN})
    if(NBVOPT_BUILD_${part} AND NOT NBVOPT_BUILD_${needed})
      message(FATAL_ERROR "NBVOPT_BUILD_${part} needs NBVOPT_BUILD_${needed}")
    endif()
  endforeach()
endfunction()

nbvopt_part_needs(STUDY SIM)
nbvopt_part_needs(PYTHON SIM SERVER)
if(NBVOPT_BUILD_ROS STREQUAL AUTO AND NOT (NBVOPT_BUILD_SIM AND NBVOPT_BUILD_SERVER))
  set(NBVOPT_BUILD_ROS OFF)
endif()
nbvopt_part_needs(ROS SIM SERVER)
nbvopt_part_needs(CLI SIM)  # without SERVER or STUDY, their commands say so
nbvopt_part_needs(BENCHMARKS TESTS CLI SERVER)  # the scenes of datasets/, the server to be measured
