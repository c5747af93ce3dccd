# Target `tidy`: clang-tidy over the sources of host/ and meshprep/, with the checks of .clang-tidy. Not part of any other target.
find_program(TEGUMENT_TIDY NAMES run-clang-tidy run-clang-tidy-14)
if(TEGUMENT_TIDY)
  add_custom_target(tidy COMMAND ${TEGUMENT_TIDY} -quiet -p ${PROJECT_BINARY_DIR} "${PROJECT_SOURCE_DIR}/(host|meshprep)/.*" USES_TERMINAL VERBATIM)
else()
  add_custom_target(tidy COMMAND ${CMAKE_COMMAND} -E echo "clang-tidy is not installed" COMMAND ${CMAKE_COMMAND} -E false VERBATIM)
endif()
