# Writes OUTPUT from build_info.h.in, touching it only when it changes.
#
#   cmake -D SOURCE_DIR=... -D VERSION=... -D COMPILER=... -D FLAGS=...
#         -D OUTPUT=... -P build_info.cmake

# Short hash of the commit, "+dirty" if tracked files differ from it. Without
# git, or in sources unpacked inside somebody else's repository: "unknown".
function(find_git_hash result)
  set(${result} unknown PARENT_SCOPE)
  find_program(GIT git)
  if(NOT GIT OR NOT EXISTS ${SOURCE_DIR}/.git)
    return()
  endif()
  execute_process(COMMAND ${GIT} rev-parse --short HEAD
    WORKING_DIRECTORY ${SOURCE_DIR} RESULT_VARIABLE failed
    OUTPUT_VARIABLE hash OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(failed)
    return()
  endif()
  # Without optional locks: a build must not get in the way of a commit.
  execute_process(
    COMMAND ${GIT} --no-optional-locks status --porcelain --untracked-files=no
    WORKING_DIRECTORY ${SOURCE_DIR} OUTPUT_VARIABLE changes ERROR_QUIET)
  if(changes)
    string(APPEND hash +dirty)
  endif()
  set(${result} ${hash} PARENT_SCOPE)
endfunction()

find_git_hash(GIT_HASH)
string(REGEX REPLACE "  +" " " FLAGS "${FLAGS}")
string(STRIP "${FLAGS}" FLAGS)
configure_file(${CMAKE_CURRENT_LIST_DIR}/build_info.h.in ${OUTPUT} @ONLY)
