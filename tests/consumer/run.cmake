# Installs the build in BUILD_DIR into a prefix of its own, then configures, builds and runs the
# consumer's programs for COMPONENTS against that prefix; a component that nobody knows must be
# refused, and the Python module must load from there, too. Run as `cmake -DBUILD_DIR=...
# -DWORK_DIR=... -DCXX=... "-DCOMPONENTS=planner;sim;client" -DWITH_PYTHON=ON -P run.cmake`.
file(REMOVE_RECURSE ${WORK_DIR})
set(configure ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR}/../../examples/consumer -B ${WORK_DIR}/build
  -G Ninja -DCMAKE_CXX_COMPILER=${CXX} -DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix)

execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/prefix
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${configure} -DCOMPONENTS=wings RESULT_VARIABLE refused ERROR_QUIET)
if(NOT refused)
  message(FATAL_ERROR "A component that does not exist was found")
endif()
execute_process(COMMAND ${configure} "-DCOMPONENTS=${COMPONENTS}" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK_DIR}/build COMMAND_ERROR_IS_FATAL ANY)
foreach(component ${COMPONENTS})
  execute_process(COMMAND ${WORK_DIR}/build/${component}_consumer COMMAND_ERROR_IS_FATAL ANY)
endforeach()
if(WITH_PYTHON)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${WORK_DIR}/prefix/share/nbvopt/python
    /usr/bin/python3 -c "import nbvopt; print(nbvopt.Robot())" COMMAND_ERROR_IS_FATAL ANY)
endif()
