# Warnings, sanitizers, and how a folder becomes a library.

add_library(tegument_options INTERFACE)
target_include_directories(tegument_options INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}>
  $<INSTALL_INTERFACE:include/tegument>)
target_compile_features(tegument_options INTERFACE cxx_std_20)
# Designated initialisers leave fields at their defaults on purpose. GCC 12 reports false positives of two more in libstdc++'s
# strings and variants (GCC bugs 105562 and 105651), GCC 14 of a third in its vectors; clang-tidy and sanitizers look for the real ones.
target_compile_options(tegument_options INTERFACE
  "$<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wconversion;-Wshadow;-Werror;-Wno-missing-field-initializers>"
  "$<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;-Wno-restrict;-Wno-free-nonheap-object>>")
set(sanitizers_address -fsanitize=address,undefined -fno-sanitize-recover=all)
# GCC 12 also finds false bounds in strings that are moved, once ThreadSanitizer's calls stand between.
set(sanitizers_thread -fsanitize=thread "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow>")
if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  # Plain x86-64 has no instruction that multiplies and adds with one rounding; elsewhere compilers use it, and bytes would differ.
  target_compile_options(tegument_options INTERFACE "$<BUILD_INTERFACE:-ffp-contract=off>")
endif()
if(TEGUMENT_QUICK)
  # Sources compiled together hide each other's names, and classes have fields of types without a name outside. Other builds look for both.
  target_compile_options(tegument_options INTERFACE "$<BUILD_INTERFACE:-Wno-shadow;$<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>>")
endif()
if(TEGUMENT_SANITIZE)
  if(NOT DEFINED sanitizers_${TEGUMENT_SANITIZE})
    message(FATAL_ERROR "TEGUMENT_SANITIZE is '${TEGUMENT_SANITIZE}': address, thread or OFF")
  endif()
  # Asserts, ours and libstdc++'s, are on here and only here: every other build that runs the tests is a release.
  target_compile_options(tegument_options INTERFACE ${sanitizers_${TEGUMENT_SANITIZE}} -fno-omit-frame-pointer -UNDEBUG -D_GLIBCXX_ASSERTIONS)
  target_link_options(tegument_options INTERFACE ${sanitizers_${TEGUMENT_SANITIZE}})
  target_sources(tegument_options INTERFACE
    "$<BUILD_INTERFACE:$<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:${PROJECT_SOURCE_DIR}/tests/runner/sanitizer_options.cpp>>")
endif()
if(TEGUMENT_FUZZ)
  target_compile_options(tegument_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# tegument_sources(variable): every .cpp in the current folder. For Windows those of its folder `windows`, too, in place of their namesakes.
function(tegument_sources variable)
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  if(WIN32)
    file(GLOB own CONFIGURE_DEPENDS windows/*.cpp)
    foreach(source IN LISTS own)
      cmake_path(GET source FILENAME name)
      list(REMOVE_ITEM sources ${CMAKE_CURRENT_SOURCE_DIR}/${name})
    endforeach()
    list(APPEND sources ${own})
  endif()
  set(${variable} ${sources} PARENT_SCOPE)
endfunction()

# tegument_library(name LIBS...): a static library of them.
function(tegument_library name)
  tegument_sources(sources)
  if(NOT sources)
    return()
  endif()
  add_library(${name} STATIC ${sources})
  target_link_libraries(${name} PUBLIC tegument_options ${ARGN})
  tegument_unite(${name})
endfunction()

# Libraries whose own loops take seconds: a quick build optimises these, too.
set(tegument_hot bench fur human image mesh meshprep_base order portrait prepare rays reference ribbons roots skin_links surroundings)

# tegument_unite(name): in a quick build a room's sources are compiled together, so that each header is read once, and optimised as far as pays.
function(tegument_unite name)
  if(TEGUMENT_QUICK)
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 0)
    string(REPLACE "tegument_" "" room ${name})
    if(NOT CMAKE_CURRENT_SOURCE_DIR MATCHES "^${PROJECT_SOURCE_DIR}/tests") # which has its own
      target_compile_options(${name} PRIVATE "$<$<CONFIG:Release>:$<IF:$<IN_LIST:${room},${tegument_hot}>,-O2,-O1>>")
    endif()
  endif()
endfunction()

# tegument_apart(SOURCES...): sources of the current folder that cannot be compiled together with the others.
function(tegument_apart)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# tegument_precompile(name HEADERS...): in a quick build the target's sources begin with these, compiled once.
function(tegument_precompile name)
  if(TEGUMENT_QUICK AND TARGET ${name})
    target_precompile_headers(${name} PRIVATE ${ARGN})
  endif()
endfunction()

# tegument_meshoptimizer(name folder): a static library of meshoptimizer's sources in that folder, whose functions begin with NAME_: an engine that
# links ours may have another version.
function(tegument_meshoptimizer name folder)
  set(functions meshopt_Allocator)
  file(GLOB sources ${folder}/*.cpp)
  foreach(file IN LISTS sources ITEMS ${folder}/meshoptimizer.h)
    file(STRINGS ${file} lines REGEX "meshopt_[A-Za-z0-9]+\\(")
    foreach(line IN LISTS lines)
      string(REGEX MATCH "(meshopt_[A-Za-z0-9]+)\\(" function "${line}")
      list(APPEND functions ${CMAKE_MATCH_1})
    endforeach()
  endforeach()
  list(REMOVE_DUPLICATES functions)
  list(TRANSFORM functions REPLACE "(.+)" "#define \\1 ${name}_\\1\n")
  list(JOIN functions "" renames)
  # written where it differs only: all that includes it is compiled again
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}_renames.h CONTENT "#define meshopt ${name}_meshopt\n${renames}" @ONLY)
  add_library(${name} STATIC ${sources})
  target_compile_options(${name} PRIVATE -w -ffp-contract=off PUBLIC "$<BUILD_INTERFACE:SHELL:-include \"${CMAKE_CURRENT_BINARY_DIR}/${name}_renames.h\">")
  target_compile_definitions(${name} PRIVATE NDEBUG) # as distributions build it: what a file may hold is checked by us
  target_include_directories(${name} SYSTEM PUBLIC $<BUILD_INTERFACE:${folder}>)
endfunction()

# tegument_find_meshoptimizer(): the target tegument_meshopt. The pinned version is the same on every system, and so are the meshes.
function(tegument_find_meshoptimizer)
  if(EXISTS "${TEGUMENT_MESHOPTIMIZER_DIR}/meshoptimizer.h")
    tegument_meshoptimizer(tegument_meshopt ${TEGUMENT_MESHOPTIMIZER_DIR})
  else()
    find_package(meshoptimizer 0.22 QUIET)
    if(NOT meshoptimizer_FOUND)
      message(FATAL_ERROR "meshoptimizer 0.22 or newer is not there: ./bootstrap build fetches its sources; or -DTEGUMENT_MESHOPTIMIZER_DIR=FOLDER names them")
    endif()
    add_library(tegument_meshopt INTERFACE)
    target_link_libraries(tegument_meshopt INTERFACE meshoptimizer::meshoptimizer)
  endif()
endfunction()
