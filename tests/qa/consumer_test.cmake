# Installs this build under WORK_DIR, then configures, builds and runs projects
# that know only the installed package: in C++, in C and, if there is a Fortran
# compiler, in Fortran; then those in C and Fortran again as pkg-config says, if
# there is pkg-config. Any failing step fails the test.

file(REMOVE_RECURSE ${WORK_DIR})
set(prefix ${WORK_DIR}/prefix)

function(run)
  execute_process(COMMAND ${ARGV}
    COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The flags go along because a sanitizer in a library is needed in the program.
function(run_project name)
  set(build ${WORK_DIR}/${name})
  set(compilers "")
  foreach(language IN LISTS ARGN)
    list(APPEND compilers
      -D CMAKE_${language}_COMPILER=${${language}_COMPILER}
      -D "CMAKE_${language}_FLAGS=${${language}_FLAGS}")
  endforeach()
  run(${CMAKE_COMMAND} -S ${SOURCE_DIR}/${name} -B ${build} -G ${GENERATOR}
    -D CMAKE_PREFIX_PATH=${prefix}
    -D CMAKE_BUILD_TYPE=${CONFIG}
    ${compilers})
  run(${CMAKE_COMMAND} --build ${build} --config "${CONFIG}")
  run(${CMAKE_CTEST_COMMAND} --test-dir ${build} -C "${CONFIG}"
    --output-on-failure --no-tests=error)
endfunction()

# One command, as it would be typed.
function(run_with_pkg_config package language source)
  string(MAKE_C_IDENTIFIER ${source} program)
  set(program ${WORK_DIR}/${package}_${program})
  set(pkg_config ${CMAKE_COMMAND} -E env
    PKG_CONFIG_PATH=${prefix}/${LIB_DIR}/pkgconfig
    ${PKG_CONFIG} --cflags --libs ${package})
  execute_process(COMMAND ${pkg_config} OUTPUT_VARIABLE flags
    COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  separate_arguments(own_flags UNIX_COMMAND "${${language}_FLAGS}")
  run(${${language}_COMPILER} ${own_flags} ${ARGN} -o ${program}
    ${SOURCE_DIR}/${source} ${flags})
  run(${CMAKE_COMMAND} -E env LD_LIBRARY_PATH=${prefix}/${LIB_DIR} ${program})
endfunction()

# DESTDIR and CMAKE_PREFIX_PATH of the caller would point elsewhere.
unset(ENV{DESTDIR})
unset(ENV{CMAKE_PREFIX_PATH})

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix}
  --config "${CONFIG}")

run_project(consumer CXX)
run_project(c_consumer C CXX)
if(Fortran_COMPILER)
  run_project(fortran_consumer CXX Fortran)
endif()

if(PKG_CONFIG)
  run_with_pkg_config(macrotask C c_consumer/main.c -std=c11)
endif()
if(PKG_CONFIG AND Fortran_COMPILER)
  foreach(package IN ITEMS macrotask_fortran macrotask_fortran_i8)
    foreach(source IN ITEMS main.f main.f90)
      run_with_pkg_config(${package} Fortran fortran_consumer/${source})
    endforeach()
  endforeach()
endif()
