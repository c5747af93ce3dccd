# cmake --install and cpack (.deb, .tar.gz): the program, effects, hlsl, workspaces, compiled effects, libraries, headers, package config.

option(TEGUMENT_PRECOMPILE "Compile the effects for engines when installing" ON)

# Targets: Tegument::host draws, Tegument::assets makes what effects take from meshes, reads effects of other hosts (its part Tegument::adopt) and writes
# meshes (Tegument::mesh_writers), Tegument::check and Tegument::emit compile for engines; the others are their parts.
add_library(tegument_host INTERFACE)
target_link_libraries(tegument_host INTERFACE tegument_run)
set(exported tegument_meshopt tegument_host tegument_assets tegument_options tegument_support tegument_rays tegument_effect tegument_adopt tegument_spirv tegument_process tegument_direct3d tegument_check
    tegument_emit tegument_gpu tegument_image tegument_mesh tegument_scene tegument_run tegument_meshprep_base tegument_mesh_writers tegument_order tegument_fur tegument_roots
    tegument_ribbons tegument_prepare tegument_skin_links tegument_surroundings tegument_portrait)
foreach(library IN LISTS exported)
  string(REGEX REPLACE "^tegument_" "" name ${library})
  set_target_properties(${library} PROPERTIES EXPORT_NAME ${name})
endforeach()
if(TARGET tegument)
  install(TARGETS tegument RUNTIME DESTINATION bin)
endif()
install(TARGETS ${exported} EXPORT TegumentTargets ARCHIVE DESTINATION lib/tegument)
install(EXPORT TegumentTargets NAMESPACE Tegument:: DESTINATION lib/cmake/Tegument)
# What a program may include: these, and no other header. A repository check keeps them from including what is not installed.
set(public_headers
    host/support/file.h host/support/layout.h host/support/result.h host/support/roots.h host/support/shader_stage.h
    host/support/state.h host/support/text.h host/effect/entry_points.h host/effect/model.h host/effect/script.h host/effect/script_run.h
    host/spirv/compile.h host/spirv/dxil.h tools/direct3d/microsoft.h tools/check/check.h tools/emit/emit.h
    host/image/compare.h host/image/dds.h host/image/image.h
    host/mesh/mesh.h host/mesh/motion.h host/scene/framing.h host/scene/placement.h host/scene/presets.h host/scene/view.h host/scene/workspace.h
    host/gpu/gpu.h host/run/geometry.h host/run/pass_request.h host/run/run.h host/run/run_options.h
    host/run/session.h host/run/session_frame.h
    meshprep/adopt/adopt.h meshprep/assets/generators.h meshprep/assets/given_values.h meshprep/assets/job.h
    meshprep/assets/names.h meshprep/assets/picture.h meshprep/assets/scene.h meshprep/portrait/head_pose.h meshprep/portrait/portrait.h
    meshprep/write/write_mesh.h)
foreach(header IN LISTS public_headers)
  cmake_path(GET header PARENT_PATH room)
  install(FILES ${header} DESTINATION include/tegument/${room})
endforeach()
install(FILES meshprep/assets/tegument.h DESTINATION include/tegument)
install(DIRECTORY effects hlsl DESTINATION share/tegument)
install(PROGRAMS meshprep/fetch.py DESTINATION share/tegument/meshprep)
if(TEGUMENT_LAB)
  install(FILES lab/bench/plot.py lab/bench/flip.py DESTINATION share/tegument/lab/bench)
endif()
# The licences of all that the programs hold: ours, and those of what is compiled in.
file(READ ${PROJECT_SOURCE_DIR}/LICENSE licences)
if(TEGUMENT_XATLAS_DIR AND EXISTS ${TEGUMENT_XATLAS_DIR}/LICENSE)
  file(READ ${TEGUMENT_XATLAS_DIR}/LICENSE licence)
  string(APPEND licences "\nCompiled in, xatlas:\n\n${licence}")
endif()
if(EXISTS "${TEGUMENT_MESHOPTIMIZER_DIR}/meshoptimizer.h")
  file(READ ${TEGUMENT_MESHOPTIMIZER_DIR}/meshoptimizer.h licence)
  string(FIND "${licence}" "/**\n * Copyright" from REVERSE) # the header ends with it
  string(SUBSTRING "${licence}" ${from} -1 licence)
  string(REGEX REPLACE "(^|\n)( \\*/|/\\*\\*\n| \\* ?)" "\\1" licence "${licence}")
  string(APPEND licences "\nCompiled in, meshoptimizer:\n\n${licence}")
  set(find_meshoptimizer "")
else()
  set(find_meshoptimizer "find_dependency(meshoptimizer)\n")
endif()
file(GENERATE OUTPUT ${PROJECT_BINARY_DIR}/copyright CONTENT "${licences}")
install(FILES ${PROJECT_BINARY_DIR}/copyright DESTINATION share/doc/tegument)
# Side by side as in the tree, so that the links of one to the other hold.
install(FILES LICENSE README.md CHANGELOG.md CONTRIBUTING.md DESTINATION share/doc/tegument)
install(DIRECTORY docs DESTINATION share/doc/tegument)
if(NOT TARGET tegument)
  return()
endif()
# The manual page, and completions where each shell looks for them.
foreach(made IN ITEMS "--man man/man1 tegument.1" "--completion=bash bash-completion/completions tegument" "--completion=zsh zsh/site-functions _tegument"
        "--completion=fish fish/vendor_completions.d tegument.fish")
  string(REPLACE " " ";" made ${made})
  list(GET made 0 option)
  list(GET made 1 folder)
  list(GET made 2 file)
  install(CODE "set(folder \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/share/${folder}\")
    file(MAKE_DIRECTORY \"\${folder}\")
    execute_process(COMMAND \"$<TARGET_FILE:tegument>\" help ${option} WORKING_DIRECTORY \"${PROJECT_SOURCE_DIR}\" OUTPUT_FILE \"\${folder}/${file}\"
                    COMMAND_ERROR_IS_FATAL ANY)")
endforeach()

# The functions of hlsl/ as one header.
file(GLOB_RECURSE library_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/hlsl/*.fxh)
add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/tegument.hlsl DEPENDS tegument ${library_sources} VERBATIM
                   COMMAND tegument flatten --library ${PROJECT_SOURCE_DIR}/hlsl/tegument.fxh -o ${PROJECT_BINARY_DIR}/tegument.hlsl)
add_custom_target(tegument_hlsl ALL DEPENDS ${PROJECT_BINARY_DIR}/tegument.hlsl)
install(FILES ${PROJECT_BINARY_DIR}/tegument.hlsl DESTINATION share/tegument)

include(CMakePackageConfigHelpers)
configure_file(cmake/TegumentConfig.cmake.in ${PROJECT_BINARY_DIR}/TegumentConfig.cmake @ONLY)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/TegumentConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/TegumentConfig.cmake ${PROJECT_BINARY_DIR}/TegumentConfigVersion.cmake DESTINATION lib/cmake/Tegument)

# What the machine's compilers make of the effects; a compiler that is missing leaves its files out, and the manifests say so.
if(TEGUMENT_PRECOMPILE)
  file(GLOB effects CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/effects/*.fx)
  list(JOIN effects "\" \"" effects) # a folder's name may hold blanks
  install(CODE "if(NOT DEFINED ENV{TEGUMENT_NO_PRECOMPILE})
  execute_process(COMMAND \"$<TARGET_FILE:tegument>\" check \"${effects}\" --skip-missing --emit \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/share/tegument/compiled\"
                  OUTPUT_QUIET ERROR_QUIET COMMAND_ERROR_IS_FATAL ANY)
endif()")
endif()

set(CPACK_GENERATOR "DEB;TGZ")
set(CPACK_PACKAGE_NAME tegument)
# Who makes a package for others names himself by DEBFULLNAME and DEBEMAIL (cmake/package), as Debian's own tools have it.
set(CPACK_PACKAGE_CONTACT "Tegument contributors <contributors@tegument.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Tegument draws human skin and fur in real time: HLSL effect files for Direct3D\n9, 10 and 11, and through SPIR-V for Vulkan. \
The program renders, checks and\nmeasures every effect, with or without a GPU, and prepares meshes for them.\nHeaders and static libraries for programs of one's own are here, too.")
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/debian.cmake)
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3:any") # runs fetch.py
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libvulkan1, mesa-vulkan-drivers, python3-pip")
# Microsoft's compiler runs in the first three; the others are what a program built against the libraries needs, docs/samples/client for one.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "wine, wine64, xvfb, g++, cmake, ninja-build, pkg-config, glslang-dev, glslang-tools, spirv-tools, libspirv-cross-c-shared-dev, libvulkan-dev, \
libopenexr-dev, libpng-dev, libjpeg-dev, libembree-dev, libdraco-dev, libopenmesh-dev, libglm-dev, libfmt-dev, nlohmann-json3-dev, \
libxxhash-dev, libtbb-dev")
include(CPack)
