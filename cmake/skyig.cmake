# One warnings target, one way to make a library and one way to make a test.

add_library(skyig_build INTERFACE)
target_compile_options(skyig_build INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror)
target_compile_definitions(skyig_build INTERFACE GLM_FORCE_XYZW_ONLY GLM_ENABLE_EXPERIMENTAL)
target_include_directories(skyig_build INTERFACE ${CMAKE_SOURCE_DIR})

if(SKYIG_SANITIZE)
  add_compile_options(-fsanitize=${SKYIG_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${SKYIG_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # gcc 12 sees uninitialised variables inside <regex> once it instruments it; other builds keep the warning.
    add_compile_options(-Wno-maybe-uninitialized)
  endif()
endif()
if(SKYIG_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all)
  add_link_options(-fsanitize=address,undefined)
endif()

# One precompiled header for every library (glm, the standard library), one for every test program (gtest and gmock
# too): a third to a half of what a small file costs to compile. Off in script/check-all's clang build, so that sources
# stay complete on their own.
option(SKYIG_PCH "Precompile the headers that most files include" ON)
function(skyig_library_headers TARGET)
  # It serves one set of compiler options: folders with others of their own set SKYIG_OWN_OPTIONS.
  if(NOT SKYIG_PCH OR SKYIG_OWN_OPTIONS)
    return()
  endif()
  if(NOT TARGET skyig_library_pch)
    file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/library_pch.cpp CONTENT "")
    add_library(skyig_library_pch OBJECT ${CMAKE_BINARY_DIR}/library_pch.cpp)
    target_link_libraries(skyig_library_pch PRIVATE skyig_build glm::glm)
    target_precompile_headers(skyig_library_pch PRIVATE
      <glm/glm.hpp> <algorithm> <array> <cmath> <cstddef> <cstdint> <functional> <memory> <optional> <span> <string>
      <string_view> <utility> <vector>)
  endif()
  target_precompile_headers(${TARGET} REUSE_FROM skyig_library_pch)
endfunction()
# skyig_own_options(OPTIONS SOURCE...): files of a library that are compiled with more than its other files.
function(skyig_own_options OPTIONS)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${OPTIONS}" SKIP_PRECOMPILE_HEADERS ON)
endfunction()

function(skyig_test_headers TARGET)
  # A precompiled header serves one level of optimisation.
  if(NOT SKYIG_PCH OR NOT "${SKYIG_TEST_OPTIMISATION}" STREQUAL "${SKYIG_USUAL_TEST_OPTIMISATION}")
    return()
  endif()
  if(NOT TARGET skyig_test_pch)
    file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/test_pch.cpp CONTENT "")
    add_library(skyig_test_pch OBJECT ${CMAKE_BINARY_DIR}/test_pch.cpp)
    target_link_libraries(skyig_test_pch PRIVATE skyig_build glm::glm GTest::gtest GTest::gmock)
    target_compile_options(skyig_test_pch PRIVATE ${SKYIG_TEST_OPTIMISATION})
    target_precompile_headers(skyig_test_pch PRIVATE
      <gmock/gmock.h> <gtest/gtest.h> <glm/glm.hpp>
      <algorithm> <array> <chrono> <cmath> <filesystem> <fstream> <map> <numbers> <optional> <random>
      <span> <sstream> <string> <string_view> <thread> <vector>)
  endif()
  target_precompile_headers(${TARGET} REUSE_FROM skyig_test_pch)
endfunction()

# script/setup and script/test compile the files of one target in batches: what their headers instantiate is compiled
# once for all of them, which more than halves a build from nothing. Where it is: folders with heavy headers, and
# targets that call it themselves. Files that repeat names of others' unnamed namespaces are named to
# skyig_compile_alone; a folder of such sets SKYIG_UNITY to OFF. Off by default, for work on single files.
option(SKYIG_UNITY "Compile files in batches, for builds from nothing" OFF)
function(skyig_compile_together TARGET)
  if(SKYIG_UNITY)
    set_target_properties(${TARGET} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    # gcc warns of types that hold one of an unnamed namespace in every file but the one it was given.
    target_compile_options(${TARGET} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()
function(skyig_compile_usually TARGET)
  file(RELATIVE_PATH folder ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  if(folder MATCHES "^(tests/)?(clients|config|protocol|server)(/|$)")
    skyig_compile_together(${TARGET})
  endif()
endfunction()

function(skyig_compile_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# skyig_library(NAME SOURCES a.cpp ... [DEPS target ...] [PRIVATE_DEPS target ...])
function(skyig_library NAME)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS;PRIVATE_DEPS" ${ARGN})
  add_library(${NAME} STATIC ${ARG_SOURCES})
  target_include_directories(${NAME} PUBLIC ${CMAKE_SOURCE_DIR})
  target_link_libraries(${NAME} PUBLIC glm::glm ${ARG_DEPS} PRIVATE skyig_build ${ARG_PRIVATE_DEPS})
  skyig_library_headers(${NAME})
  skyig_compile_usually(${NAME})
endfunction()

# What is tested is optimised, the tests' own code hardly: that is two thirds of what it costs to compile. Folders
# whose tests compute much themselves set SKYIG_TEST_OPTIMISATION to -O1 under the sanitizers too.
if(SKYIG_SANITIZE)
  set(SKYIG_TEST_OPTIMISATION -O0)
elseif(CMAKE_BUILD_TYPE STREQUAL "Release")
  set(SKYIG_TEST_OPTIMISATION -O1)
endif()
set(SKYIG_USUAL_TEST_OPTIMISATION ${SKYIG_TEST_OPTIMISATION})

# skyig_test(NAME SOURCES a.cpp ... DEPS target ... [LABELS unit|gl|slow|net] [TIMEOUT s] [DESKTOP])
# DESKTOP runs it before a virtual X server of its own.
# Every test program finds its data under SKYIG_TEST_DATA and what this clone may lack under
# SKYIG_REFERENCE (absent on a lone clone: such a test says so and is skipped).
function(skyig_test NAME)
  cmake_parse_arguments(ARG "DESKTOP" "TIMEOUT" "SOURCES;DEPS;LABELS" ${ARGN})
  if(NOT ARG_LABELS)
    set(ARG_LABELS unit)
  endif()
  if("slow" IN_LIST ARG_LABELS AND NOT SKYIG_SLOW_TESTS)
    return()
  endif()
  if(NOT ARG_TIMEOUT)
    # Ends a test that hangs; far above what the slowest takes under a sanitizer on a busy machine.
    set(ARG_TIMEOUT 600)
  endif()
  add_executable(${NAME} ${ARG_SOURCES})
  target_include_directories(${NAME} PRIVATE ${CMAKE_SOURCE_DIR})
  target_link_libraries(${NAME} PRIVATE skyig_build ${ARG_DEPS} GTest::gtest_main GTest::gmock)
  target_compile_options(${NAME} PRIVATE ${SKYIG_TEST_OPTIMISATION})
  skyig_test_headers(${NAME})
  skyig_compile_usually(${NAME})
  target_compile_definitions(${NAME} PRIVATE
    SKYIG_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
    SKYIG_TEST_DATA="${CMAKE_SOURCE_DIR}/tests/data"
    SKYIG_REFERENCE="${CMAKE_SOURCE_DIR}/../shared/reference")
  if(ARG_DESKTOP)
    add_test(NAME ${NAME} COMMAND xvfb-run -a -s "-screen 0 3840x1080x24" $<TARGET_FILE:${NAME}>)
  else()
    add_test(NAME ${NAME} COMMAND ${NAME})
  endif()
  set_tests_properties(${NAME} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT})
endfunction()
