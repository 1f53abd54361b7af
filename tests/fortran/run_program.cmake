# Runs PROGRAM with ARGUMENT. Passes if it ends with EXIT_CODE before TIMEOUT,
# and OUTPUT and ERROR, regular expressions, match what it prints.
execute_process(COMMAND ${PROGRAM} ${ARGUMENT} TIMEOUT ${TIMEOUT}
  RESULT_VARIABLE exit_code OUTPUT_VARIABLE output ERROR_VARIABLE error)
message("${output}${error}")
if(NOT exit_code STREQUAL EXIT_CODE)
  message(FATAL_ERROR "ended with ${exit_code}: expected ${EXIT_CODE}")
endif()
if(NOT output MATCHES "${OUTPUT}")
  message(FATAL_ERROR "the output does not match ${OUTPUT}")
endif()
if(NOT error MATCHES "${ERROR}")
  message(FATAL_ERROR "the error output does not match ${ERROR}")
endif()
