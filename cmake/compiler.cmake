# What every roam target is compiled with: warnings, and the floating-point rules that the proofs rely on.
add_library(roam_compiler INTERFACE)
target_compile_options(roam_compiler INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow
  $<$<BOOL:${ROAM_WERROR}>:-Werror>
  # The error bounds of docs/algorithm.md count every rounding: no fused multiply-add, no reordering.
  -ffp-contract=off -fno-fast-math
  # g++ 12.2 drops the rounding of double -> float -> double in 3-vectors (its SLP vectoriser) at -O2 and above.
  $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)

# Builds again what it has built before from its cache, where ccache is there.
find_program(ROAM_CCACHE ccache)
mark_as_advanced(ROAM_CCACHE)
if(ROAM_CCACHE AND PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${ROAM_CCACHE})
endif()

# Programs under the thread sanitizer know what it must overlook in libraries that were built without it.
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize=[a-z,]*thread")
  add_library(roam_sanitizer OBJECT ${CMAKE_CURRENT_LIST_DIR}/sanitizers.cpp)
  link_libraries($<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:roam_sanitizer>)
endif()
