# Installs this build under WORK_DIR, then configures, builds and runs the
# consumer project against it. Any failing step fails the test.

file(REMOVE_RECURSE ${WORK_DIR})
set(prefix ${WORK_DIR}/prefix)

function(run)
  execute_process(COMMAND ${ARGV}
    COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# DESTDIR and CMAKE_PREFIX_PATH of the caller would point elsewhere.
unset(ENV{DESTDIR})
unset(ENV{CMAKE_PREFIX_PATH})

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix}
  --config "${CONFIG}")
# The flags go along because a sanitizer in a library is needed in the program.
run(${CMAKE_COMMAND} -S ${CONSUMER_DIR} -B ${WORK_DIR}/build -G ${GENERATOR}
  -D CMAKE_PREFIX_PATH=${prefix}
  -D CMAKE_BUILD_TYPE=${CONFIG}
  -D CMAKE_CXX_COMPILER=${CXX_COMPILER}
  -D "CMAKE_CXX_FLAGS=${CXX_FLAGS}")
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build --config "${CONFIG}")
run(${CMAKE_CTEST_COMMAND} --test-dir ${WORK_DIR}/build -C "${CONFIG}"
  --output-on-failure --no-tests=error)
