# What Debian asks of a package beside its files; CPack runs it before it packs. A manual and a changelog, both compressed.
if(NOT CPACK_GENERATOR STREQUAL DEB)
  return()
endif()
file(GLOB_RECURSE manuals ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/tegument.1)
file(READ ${CMAKE_CURRENT_LIST_DIR}/../CITATION.cff citation)
string(REGEX MATCH "date-released: \"([0-9-]+)\"" released "${citation}")
execute_process(COMMAND date --utc --rfc-email --date ${CMAKE_MATCH_1} OUTPUT_VARIABLE date COMMAND_ERROR_IS_FATAL ANY)
set(changelog ${CPACK_TEMPORARY_INSTALL_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX}/share/doc/tegument/changelog)
file(WRITE ${changelog} "tegument (${CPACK_PACKAGE_VERSION}) unstable; urgency=medium\n\n  * CHANGELOG.md beside this file says what is new.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}")
execute_process(COMMAND gzip -9nf ${changelog} ${manuals} COMMAND_ERROR_IS_FATAL ANY)
# Where Debian's zsh looks.
set(share ${CPACK_TEMPORARY_INSTALL_DIRECTORY}${CPACK_PACKAGING_INSTALL_PREFIX}/share/zsh)
file(RENAME ${share}/site-functions ${share}/vendor-completions)
