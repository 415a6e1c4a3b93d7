# Installs the build tree BUILD below WORK, then configures, builds and runs the project SOURCE
# against what was installed.
function(must)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "exit ${status} of: ${ARGV}\n${said}")
  endif()
  message("${said}")
endfunction()

file(REMOVE_RECURSE ${WORK})
must(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
must(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G ${GENERATOR}
  -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${WORK}/prefix)
must(${CMAKE_COMMAND} --build ${WORK}/build)
must(${WORK}/build/consumer)
must(${WORK}/prefix/bin/penumbra --version)
if(NOT EXISTS ${WORK}/prefix/include/penumbra/parker.h)
  message(FATAL_ERROR "the header was not installed")
endif()
