# cmake -D PROGRAM=<stress> -P expect_failure.cmake
#
# Succeeds if the stress program finds something: exits with 1 or 3. Any other
# way to fail, a wrong call for instance, has found nothing.
execute_process(COMMAND ${PROGRAM} 5 3 RESULT_VARIABLE result
  OUTPUT_VARIABLE said ERROR_VARIABLE said)
message(STATUS "exit code ${result}\n${said}")
if(NOT result MATCHES "^[13]$")
  message(FATAL_ERROR "the planted bug was not found")
endif()
