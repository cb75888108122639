# Engines that Debian and Ubuntu do not have, from where the user built them: Jolt and Box3D by their CMake packages,
# PhysX by its folder. Each is left out when it is not there. docs/benchmarks.md shows the commands.
set(ROAM_PHYSX_DIR "" CACHE PATH "Folder of a built PhysX with include/ and bin/, for roam bench; empty: without it")
find_package(Jolt CONFIG QUIET)
find_package(box3d CONFIG QUIET)

if(ROAM_PHYSX_DIR AND NOT TARGET roam_physx)
  file(GLOB physx_folders ${ROAM_PHYSX_DIR}/bin/*/release)
  add_library(roam_physx INTERFACE)
  target_include_directories(roam_physx SYSTEM INTERFACE ${ROAM_PHYSX_DIR}/include)
  # In the order in which static libraries need each other.
  foreach(part IN ITEMS CharacterKinematic Extensions "" Cooking Common PvdSDK Foundation)
    find_library(ROAM_PHYSX_${part}_LIBRARY NAMES PhysX${part}_static_64 PhysX${part}_64
                 HINTS ${physx_folders} NO_DEFAULT_PATH REQUIRED)
    target_link_libraries(roam_physx INTERFACE ${ROAM_PHYSX_${part}_LIBRARY})
  endforeach()
  target_link_libraries(roam_physx INTERFACE ${CMAKE_DL_LIBS})
endif()

# roam_native_engine(NAME TARGET SOURCE...): a library of its own, because the engine's flags must not reach roam's
# code. PhysX and Jolt are built without RTTI.
function(roam_native_engine name target)
  if(NOT TARGET ${target})
    return()
  endif()
  add_library(roam_bench_${name} STATIC ${ARGN})
  target_link_libraries(roam_bench_${name} PRIVATE roam_bench roam_compiler ${target})
  target_compile_options(roam_bench_${name} PRIVATE -fno-rtti -ffp-contract=off)
  target_compile_definitions(roam_bench_${name} PRIVATE NDEBUG)  # the engine's headers, as its own release has them
  target_link_libraries(roam_bench_engines PRIVATE roam_bench_${name})
  string(TOUPPER ${name} upper)
  target_compile_definitions(roam_bench_engines PUBLIC ROAM_BENCH_${upper})
endfunction()
roam_native_engine(physx roam_physx engine_physx.cpp controller_physx.cpp)
roam_native_engine(jolt Jolt::Jolt engine_jolt.cpp controller_jolt.cpp)
if(TARGET roam_bench_jolt)
  target_compile_options(roam_bench_jolt PRIVATE "SHELL:-include Jolt/Jolt.h")  # before all other headers of Jolt
endif()
roam_native_engine(box3d box3d::box3d engine_box3d.cpp)
