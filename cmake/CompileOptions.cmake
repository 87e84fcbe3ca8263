# The flags that every pillowmesh target is compiled with, so that native and WebAssembly builds give the same bits:
# no fused multiply-add, and no vectorised Eigen, whose reductions sum in another order with SSE.
function(pillowmesh_compile_options target)
  set_target_properties(${target} PROPERTIES
    CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF
    C_STANDARD 11 C_STANDARD_REQUIRED ON)
  if(NOT EMSCRIPTEN)
    # A static core can be linked into somebody's shared library.
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  endif()
  target_compile_definitions(${target} PRIVATE EIGEN_DONT_VECTORIZE)
  if(NOT MSVC)
    target_compile_options(${target} PRIVATE -ffp-contract=off -fno-math-errno -Wno-psabi)
  endif()
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    # Position-independent code without it is not inlined: any function could be replaced at run time.
    target_compile_options(${target} PRIVATE -fno-semantic-interposition)
    # A unity build includes sources: GCC then warns of what is in their unnamed namespaces.
    if(CMAKE_UNITY_BUILD)
      target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
    endif()
  endif()
  if(PILLOWMESH_WARNINGS AND NOT MSVC)
    target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Werror>)
  endif()
endfunction()
