# Target `tidy`: clang-tidy over all sources, tests included, with the checks of .clang-tidy and of tests/.clang-tidy. Not part of any other target.
find_program(TEGUMENT_TIDY NAMES clang-tidy-14 clang-tidy)
find_package(Python3 REQUIRED COMPONENTS Interpreter)
if(TEGUMENT_TIDY)
  add_custom_target(tidy COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_LIST_DIR}/tidy.py ${TEGUMENT_TIDY} ${PROJECT_BINARY_DIR} USES_TERMINAL VERBATIM)
else()
  add_custom_target(tidy COMMAND ${CMAKE_COMMAND} -E echo "clang-tidy is not installed" COMMAND ${CMAKE_COMMAND} -E false VERBATIM)
endif()

# Headers that the build makes for a program in the current folder. clang-tidy reads them too, so the target `tidy` makes them first;
# they are another tool's text, and as headers of the system they are not judged.
function(tegument_generated_headers program)
  add_custom_target(${program}_headers DEPENDS ${ARGN})
  add_dependencies(${program} ${program}_headers)
  add_dependencies(tidy ${program}_headers)
  target_include_directories(${program} SYSTEM PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
endfunction()
