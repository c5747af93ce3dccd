# Installs into a folder of its own, builds `consumer` against it, runs it and the installed program from elsewhere.
set(work ${BUILD}/install_test)
file(REMOVE_RECURSE ${work})
file(MAKE_DIRECTORY ${work}/elsewhere)

function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${work}/elsewhere RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${status}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

set(ENV{TEGUMENT_NO_PRECOMPILE} 1) # compiling the effects has tests of its own
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${work}/package --strip)

# Every installed header compiles alone, from what is installed, and begins by saying what it is for. Designated
# initialisers leave fields at their defaults on purpose.
file(GLOB_RECURSE headers RELATIVE ${work}/package/include/tegument ${work}/package/include/tegument/*.h)
list(LENGTH headers count)
if(count EQUAL 0)
  message(FATAL_ERROR "no header is installed")
endif()
foreach(header IN LISTS headers)
  file(READ ${work}/package/include/tegument/${header} text)
  if(NOT text MATCHES "^#pragma once\n// [A-Z]" OR text MATCHES "[Ii]nside (host|this room)")
    message(FATAL_ERROR "${header} is not meant for users")
  endif()
  run(${COMPILER} -std=c++20 -Wall -Wextra -Wpedantic -Wno-missing-field-initializers -Werror -fsyntax-only -I${work}/package/include/tegument -include ${header} -x c++ /dev/null)
endforeach()

run(${CMAKE_COMMAND} -S ${SOURCE}/consumer -B ${work}/consumer -G Ninja -DCMAKE_PREFIX_PATH=${work}/package -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
run(${CMAKE_COMMAND} --build ${work}/consumer)
run(${work}/consumer/consumer ${work}/package/share/tegument/effects/OriginalTexture.fx)
if(NOT output MATCHES "OriginalTexture: 1 pass, 2 shaders, GLSL of 2")
  message(FATAL_ERROR "the consumer said:\n${output}")
endif()

file(READ ${work}/package/share/tegument/tegument.hlsl library)
run(${work}/package/bin/tegument flatten --library)
if(NOT output STREQUAL library)
  message(FATAL_ERROR "share/tegument/tegument.hlsl is not what the installed program makes of share/tegument/hlsl")
endif()

run(${work}/package/bin/tegument info OriginalTexture.fx)
if(NOT output MATCHES "package/share/tegument/effects/OriginalTexture.fx.*technique OriginalTexture: 1 passes")
  message(FATAL_ERROR "the installed program does not find its effects:\n${output}")
endif()
run(${work}/package/bin/tegument render Beckmann.fx --size 16x16 -o beckmann.png)
if(NOT output MATCHES "wrote beckmann.png")
  message(FATAL_ERROR "the installed program does not draw with its effects:\n${output}")
endif()
file(REMOVE_RECURSE ${work})
