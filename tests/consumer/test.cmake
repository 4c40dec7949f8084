# cmake -DBUILD=... -DGENERATOR=... -DCOMPILER=... -P test.cmake: installs a build, moves what was installed, and uses it there.
set(place ${BUILD}/consumer)
set(prefix "${place}/moved here")
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${place})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${place}/installed)
file(RENAME ${place}/installed ${prefix})
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${place}/build -G ${GENERATOR} -DCMAKE_BUILD_TYPE=Release
  -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} --build ${place}/build)
run(${place}/build/consumer)
if(EXISTS ${prefix}/bin/heml)
  run(${prefix}/bin/heml capture --out ${place}/frames --frames 1 --size 320x180)
endif()
