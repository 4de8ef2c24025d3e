# SPDX-FileCopyrightText: 2026 The Regolith authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Language, warnings, sanitizers and ccache, for every target.
set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_VERIFY_INTERFACE_HEADER_SETS ON)

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

find_program(REGOLITH_CCACHE ccache)
if(REGOLITH_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${REGOLITH_CCACHE})
endif()

add_library(regolith_compiler INTERFACE)
target_compile_options(
  regolith_compiler
  INTERFACE -Wall -Wextra -Wshadow -Wconversion -Werror
            # GCC 12 reports reads past small Eigen vectors in AVX branches that are never taken.
            $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds -Wno-maybe-uninitialized>
            # A fused multiply-add in one translation unit and not in another makes results depend on
            # inlining; offline runs promise the same bytes.
            -ffp-contract=off)
target_include_directories(regolith_compiler INTERFACE ${CMAKE_SOURCE_DIR}/src)

# x86-64-v3 (AVX2) is every rover-class x86 computer of the last ten years; other processors get their default.
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  target_compile_options(regolith_compiler INTERFACE -march=x86-64-v3)
endif()

if(REGOLITH_SANITIZERS)
  add_compile_options(-fsanitize=${REGOLITH_SANITIZERS} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${REGOLITH_SANITIZERS})
endif()
