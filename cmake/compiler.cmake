# What every roam target is compiled with: warnings, and the floating-point rules that the proofs rely on.
add_library(roam_compiler INTERFACE)
target_compile_options(roam_compiler INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow
  $<$<BOOL:${ROAM_WERROR}>:-Werror>
  # The error bounds of docs/algorithm.md count every rounding: no fused multiply-add, no reordering.
  -ffp-contract=off -fno-fast-math
  # g++ 12.2 drops the rounding of double -> float -> double in 3-vectors (its SLP vectoriser) at -O2 and above.
  $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)
