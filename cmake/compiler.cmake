# Options for all targets of roam: warnings, and the floating-point rules that the proofs rely on.
add_library(roam_compiler INTERFACE)
target_compile_options(roam_compiler INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow
  $<$<BOOL:${ROAM_WERROR}>:-Werror>
  # The error bounds of docs/algorithm.md count every rounding: no fused multiply-add, no reordering.
  -ffp-contract=off -fno-fast-math
  # g++ 12.2 drops the rounding of double -> float -> double in 3-vectors (its SLP vectoriser) at -O2 and above.
  $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)

# Use ccache, if it is installed, to build faster.
find_program(ROAM_CCACHE ccache)
mark_as_advanced(ROAM_CCACHE)
if(ROAM_CCACHE AND PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${ROAM_CCACHE})
endif()

# roam_unity(TARGET...): compiles several files of a target together, in less than half of the time. Names in unnamed
# namespaces must then differ in a target. ROAM_UNITY=OFF compiles each file alone: that shows missing includes.
function(roam_unity)
  set_target_properties(${ARGN} PROPERTIES UNITY_BUILD ${ROAM_UNITY})
  if(ROAM_UNITY)
    foreach(target IN LISTS ARGN)
      # g++ takes types of an included file for types of a header.
      target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
    endforeach()
  endif()
endfunction()

# Link sanitizers.cpp into every program of a build with a sanitizer.
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize=[a-z,]*(thread|address)")
  add_library(roam_sanitizer OBJECT ${CMAKE_CURRENT_LIST_DIR}/sanitizers.cpp)
  link_libraries($<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:roam_sanitizer>)
endif()
