# Installs the build in BUILD_DIR into a prefix of its own, then configures, builds and runs the
# consumer against that prefix; the Python module must load from there, too. Run as
# `cmake -DBUILD_DIR=... -DWORK_DIR=... -DCXX=... -DWITH_PYTHON=ON -P run.cmake`.
file(REMOVE_RECURSE ${WORK_DIR})
foreach(command
    "--install;${BUILD_DIR};--prefix;${WORK_DIR}/prefix"
    "-S;${CMAKE_CURRENT_LIST_DIR}/../../examples/consumer;-B;${WORK_DIR}/build;-G;Ninja;-DCMAKE_CXX_COMPILER=${CXX};-DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix"
    "--build;${WORK_DIR}/build")
  execute_process(COMMAND ${CMAKE_COMMAND} ${command} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
foreach(program consumer sim_consumer client_consumer)
  execute_process(COMMAND ${WORK_DIR}/build/${program} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
if(WITH_PYTHON)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${WORK_DIR}/prefix/share/nbvopt/python
    /usr/bin/python3 -c "import nbvopt; print(nbvopt.Robot())" COMMAND_ERROR_IS_FATAL ANY)
endif()
