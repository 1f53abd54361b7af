# cmake -D SPIN=<spin> -D CC=<compiler> -D MODEL=<file.pml> -D SOURCE_DIR=<root>
#       -D WORK_DIR=<directory> -P check_model.cmake
#
# Runs a model as the lines of its header say, a process each:
#
#   // proves NAME=VALUE...   the search is complete and finds no error
#   // finds BUG=NAME...      the search finds an error: the checker can fail
#
# and holds the model against the source that it models: what a comment
# "counting_barrier.cc: text" quotes must still stand in
# macrotask/counting_barrier.cc, but for white space. What is too long for the
# line goes on in the next one, behind "//" and five spaces.
cmake_minimum_required(VERSION 3.25)

file(STRINGS ${MODEL} lines)
cmake_path(GET MODEL STEM name)
file(REMOVE_RECURSE ${WORK_DIR}/${name})

# Semicolons and brackets mean something in a CMake list.
function(read_flat file result)
  file(READ ${file} text)
  string(REGEX REPLACE "[ \t\r\n]+" " " text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

function(check_quotations)
  file(READ ${MODEL} rest)
  string(REGEX REPLACE "\n *//     " " " rest "${rest}")
  set(num_quotations 0)
  while(rest MATCHES "// ([a-z_]+\\.(cc|h)): ([^\n]*)\n")
    set(source ${CMAKE_MATCH_1})
    set(quotation "${CMAKE_MATCH_3}")
    string(FIND "${rest}" "${CMAKE_MATCH_0}" position)
    string(LENGTH "${CMAKE_MATCH_0}" length)
    math(EXPR position "${position} + ${length}")
    string(SUBSTRING "${rest}" ${position} -1 rest)
    read_flat(${SOURCE_DIR}/macrotask/${source} text)
    string(FIND "${text}" "${quotation}" position)
    if(position EQUAL -1)
      message(SEND_ERROR "${name}.pml quotes what macrotask/${source} says no "
        "more; does the model still hold?\n  ${quotation}")
    endif()
    math(EXPR num_quotations "${num_quotations} + 1")
  endwhile()
  if(num_quotations EQUAL 0)
    message(FATAL_ERROR "${name}.pml quotes nothing of what it models")
  endif()
endfunction()

# Sets `errors` to how many the search found and `error` to the first,
# `complete` to whether it saw all there is, `states` to how many those were. To
# compile with -O0 takes a third of the time, to search longer.
function(search defines optimization)
  string(MAKE_C_IDENTIFIER "${defines}" run)
  set(directory ${WORK_DIR}/${name}/${run})
  file(MAKE_DIRECTORY ${directory})
  list(TRANSFORM defines PREPEND -D)
  execute_process(COMMAND ${SPIN} ${defines} -a ${MODEL}
    WORKING_DIRECTORY ${directory} OUTPUT_VARIABLE said ERROR_VARIABLE said
    RESULT_VARIABLE failed)
  if(failed OR NOT EXISTS ${directory}/pan.c)
    message(FATAL_ERROR "spin ${defines} -a ${MODEL}\n${said}")
  endif()
  execute_process(COMMAND ${CC} -w ${optimization} -DSAFETY -o pan pan.c
    WORKING_DIRECTORY ${directory} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ./pan -m1000000 -w22
    WORKING_DIRECTORY ${directory} OUTPUT_VARIABLE said ERROR_VARIABLE said)
  file(WRITE ${directory}/said "${said}")
  if(NOT said MATCHES "errors: ([0-9]+)")
    message(FATAL_ERROR "the search of ${directory} says nothing:\n${said}")
  endif()
  set(errors ${CMAKE_MATCH_1} PARENT_SCOPE)
  if(said MATCHES "Search not completed|max search depth too small")
    set(complete FALSE PARENT_SCOPE)
  else()
    set(complete TRUE PARENT_SCOPE)
  endif()
  string(REGEX MATCH "pan:1: [^\n]*" error "${said}")
  string(REGEX MATCH "[0-9.e+]+ states, stored" states "${said}")
  set(states "${states}" PARENT_SCOPE)
  set(error "${error}" PARENT_SCOPE)
endfunction()

check_quotations()
set(num_proves 0)
set(num_finds 0)
foreach(line IN LISTS lines)
  if(line MATCHES "^// proves (.*)$")
    string(REPLACE " " ";" defines "${CMAKE_MATCH_1}")
    search("${defines}" -O1)
    if(errors OR NOT complete)
      message(SEND_ERROR
        "${line}: ${error}; replay with spin -t in ${WORK_DIR}")
    endif()
    message(STATUS "${line}: ${states}")
    math(EXPR num_proves "${num_proves} + 1")
  elseif(line MATCHES "^// finds (.*)$")
    string(REPLACE " " ";" defines "${CMAKE_MATCH_1}")
    search("${defines}" -O0)
    if(NOT errors)
      message(SEND_ERROR "${line}: nothing found in ${states}")
    endif()
    message(STATUS "${line}: ${error}")
    math(EXPR num_finds "${num_finds} + 1")
  endif()
endforeach()
if(num_proves EQUAL 0 OR num_finds EQUAL 0)
  message(FATAL_ERROR "${name}.pml proves or finds nothing")
endif()
