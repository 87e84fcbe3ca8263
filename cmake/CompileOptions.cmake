# The flags that every pillowmesh target is compiled with, so that native and WebAssembly builds give the same bits:
# no fused multiply-add, and no vectorised Eigen, whose reductions sum in another order with SSE.
function(pillowmesh_compile_options target)
  set_target_properties(${target} PROPERTIES
    CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF
    C_STANDARD 11 C_STANDARD_REQUIRED ON
    POSITION_INDEPENDENT_CODE ON)
  target_compile_definitions(${target} PRIVATE EIGEN_DONT_VECTORIZE)
  if(NOT MSVC)
    target_compile_options(${target} PRIVATE -ffp-contract=off -fno-math-errno)
  endif()
  if(PILLOWMESH_WARNINGS AND NOT MSVC)
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Werror>)
  endif()
endfunction()
