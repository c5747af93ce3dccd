# How tests are built and told to ctest. What ctest calls skipped is an exit code of 77, never a line of output: a failure beside a skip is red.
# tests/tools/red_test.py holds this by cases that fail.

set(TEGUMENT_TEST_PROGRAMS "" CACHE STRING "GoogleTest programs to build and run, nothing else; empty: all tests")
add_custom_target(test_programs)

# tegument_test_program(name): the GoogleTest program gets the main of tests/runner, and is built with the others unless it is left out. Its
# sources are compiled together in a quick build.
function(tegument_test_program name)
  target_link_libraries(${name} PRIVATE tegument_test_main)
  tegument_unite(${name})
  if(TEGUMENT_TEST_PROGRAMS AND NOT name IN_LIST TEGUMENT_TEST_PROGRAMS)
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL TRUE)
  else()
    add_dependencies(test_programs ${name})
  endif()
endfunction()

# tegument_cases(name label [property value]...): each case of the program is a test and a process of its own. @PART@ in a property is the number
# that stands behind `part_` in the case's name.
function(tegument_cases name label)
  if(TEGUMENT_TEST_PROGRAMS AND NOT name IN_LIST TEGUMENT_TEST_PROGRAMS)
    return()
  endif()
  set(include ${CMAKE_CURRENT_BINARY_DIR}/${name}_cases.cmake)
  file(GENERATE OUTPUT ${include} CONTENT
"set(name ${name})
set(program [==[$<TARGET_FILE:${name}>]==])
set(folder [==[${PROJECT_SOURCE_DIR}]==])
set(properties LABELS ${label} SKIP_RETURN_CODE 77 ${ARGN})
include([==[${CMAKE_CURRENT_FUNCTION_LIST_DIR}/discover.cmake]==])
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include})
endfunction()

# tegument_one_process(test name label [argument]...): all cases of the program are one test, because they share what is costly to set up. It
# is skipped when all of them are.
function(tegument_one_process test name label)
  if(TEGUMENT_TEST_PROGRAMS AND NOT name IN_LIST TEGUMENT_TEST_PROGRAMS)
    return()
  endif()
  add_test(NAME ${test} COMMAND ${name} ${ARGN} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(${test} PROPERTIES LABELS ${label} SKIP_RETURN_CODE 77)
endfunction()

# tegument_parts(test name label count [argument]...): the same in `count` processes, TEST_1 to TEST_count, to which GoogleTest deals the cases out.
function(tegument_parts test name label count)
  foreach(part RANGE 1 ${count})
    tegument_one_process(${test}_${part} ${name} ${label} ${ARGN})
    if(TEST ${test}_${part})
      math(EXPR index "${part} - 1")
      set_tests_properties(${test}_${part} PROPERTIES ENVIRONMENT "GTEST_TOTAL_SHARDS=${count};GTEST_SHARD_INDEX=${index}")
    endif()
  endforeach()
endfunction()

# tegument_command(test label command [argument]...): any other program; exit code 77 says that it is skipped.
function(tegument_command test label)
  if(TEGUMENT_TEST_PROGRAMS)
    return()
  endif()
  add_test(NAME ${test} COMMAND ${ARGN} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(${test} PROPERTIES LABELS ${label} SKIP_RETURN_CODE 77)
endfunction()

# tegument_tests(name LABEL libs...): one GoogleTest program of every *_test.cpp in the current folder, run from the repository root.
function(tegument_tests name label)
  file(GLOB sources CONFIGURE_DEPENDS *_test.cpp)
  if(NOT sources)
    message(FATAL_ERROR "${CMAKE_CURRENT_SOURCE_DIR} has no *_test.cpp")
  endif()
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE tegument_options ${ARGN})
  tegument_test_program(${name})
  tegument_cases(${name} ${label})
endfunction()

# tegument_check_test_programs(): a name that no program has would leave its tests out unseen.
function(tegument_check_test_programs)
  foreach(name IN LISTS TEGUMENT_TEST_PROGRAMS)
    if(NOT TARGET ${name})
      message(FATAL_ERROR "TEGUMENT_TEST_PROGRAMS names ${name}: there is no such program")
    endif()
  endforeach()
endfunction()
