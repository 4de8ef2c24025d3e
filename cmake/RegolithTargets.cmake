# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
#
# One folder = one library. Headers are a verified header set: each must compile alone
# (target all_verify_interface_header_sets).

# regolith_library(<folder> SOURCES <.cc>... HEADERS <.h>... [LINK <targets>...] [PRIVATE_LINK <targets>...])
# makes the library regolith_<folder>; LINK names what its headers need, PRIVATE_LINK what its .cc files need.
function(regolith_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;HEADERS;LINK;PRIVATE_LINK")
  set(target regolith_${name})
  if(arg_SOURCES)
    add_library(${target} STATIC ${arg_SOURCES})
    set(scope PUBLIC)
    target_link_libraries(${target} PUBLIC regolith_compiler ${arg_LINK} PRIVATE ${arg_PRIVATE_LINK})
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
    target_link_libraries(${target} INTERFACE regolith_compiler ${arg_LINK})
  endif()
  target_sources(${target} ${scope} FILE_SET HEADERS BASE_DIRS ${CMAKE_SOURCE_DIR}/src FILES ${arg_HEADERS})
endfunction()

# regolith_test(<folder> SOURCES <_test.cc>... [LINK <targets>...])
# makes the program regolith_<folder>_test and registers each of its tests with ctest.
function(regolith_test name)
  if(NOT REGOLITH_TESTS)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LINK")
  set(target regolith_${name}_test)
  add_executable(${target} ${arg_SOURCES})
  target_link_libraries(${target} PRIVATE regolith_compiler ${arg_LINK} GTest::gtest GTest::gmock GTest::gtest_main)
  target_compile_definitions(${target} PRIVATE REGOLITH_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  gtest_discover_tests(${target} TEST_PREFIX "${name}." DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
endfunction()
