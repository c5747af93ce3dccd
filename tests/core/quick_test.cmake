# Builds what `./bootstrap demo` builds, and asks the program for its version. The folder is kept: a second run compiles what has changed.
set(work ${BUILD}/quick_test)
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${work} -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${COMPILER}
                        -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -DTEGUMENT_DXC_DIR=${DXC} -DTEGUMENT_XATLAS_DIR=${XATLAS}
                        -DTEGUMENT_LAB=OFF -DTEGUMENT_TESTS=OFF -DTEGUMENT_QUICK=ON
                RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "a quick build does not configure\n${output}")
endif()

file(READ ${work}/compile_commands.json commands)
string(REGEX MATCHALL "/Unity/unity_0_cxx.cxx\"" united "${commands}")
list(LENGTH united rooms)
if(rooms LESS 20) # support, effect, spirv, direct3d, check, emit, gpu, image, mesh, scene, run, view, app, and those of meshprep
  message(FATAL_ERROR "only ${rooms} rooms are compiled as one source")
endif()

execute_process(COMMAND ${CMAKE_COMMAND} --build ${work} --target tegument RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "a quick build does not compile. Names that two sources of a room keep to themselves? "
                      "Then one of them belongs into the room's tegument_apart (cmake/tegument.cmake).\n${output}")
endif()
execute_process(COMMAND ${work}/tegument --version RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "--version ends with ${status}\n${output}")
endif()
