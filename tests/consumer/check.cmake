# Installs BUILD into a fresh prefix, then configures, builds and runs the project in CONSUMER against it.
set(prefix ${BUILD}/consumer/prefix)
file(REMOVE_RECURSE ${BUILD}/consumer)
file(MAKE_DIRECTORY ${BUILD}/consumer/build)

function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${BUILD}/consumer/build COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${CMAKE_COMMAND} -S ${CONSUMER} -B . -G Ninja -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${CXX})
run(${CMAKE_COMMAND} --build .)
run(${BUILD}/consumer/build/consumer)
run(${prefix}/bin/nephroid --version)
