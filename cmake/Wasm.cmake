# build/wasm/pillowmesh.wasm: the core behind a C ABI (wasm/c_api.cpp), without generated JavaScript. The functions
# exported are those that c_api.cpp marks with export_name or EMSCRIPTEN_KEEPALIVE.
file(GLOB wasm_sources CONFIGURE_DEPENDS wasm/*.cpp)
if(NOT wasm_sources)
  return()
endif()

# The page downloads this: what is not hot is compiled for size, which takes a fifth off the module.
string(JOIN "|" hot
  "refine/" "smooth/" "quality/" "metric/(program|field|length|volume)" "adapt/(adapter|tagging)" "mesh/(slide|topology)")
foreach(source ${core_sources} ${wasm_sources})
  if(NOT source MATCHES "pillowmesh/(${hot})|third_party")
    set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -Os)
  endif()
endforeach()

add_executable(pillowmesh_wasm ${wasm_sources})
pillowmesh_compile_options(pillowmesh_wasm)
target_include_directories(pillowmesh_wasm PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_compile_definitions(pillowmesh_wasm PRIVATE PILLOWMESH_VERSION="${PROJECT_VERSION}")
target_compile_options(pillowmesh_wasm PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-fno-exceptions -fno-rtti>)
target_link_libraries(pillowmesh_wasm PRIVATE pillowmesh::core)
target_link_options(pillowmesh_wasm PRIVATE
  --no-entry -sSTANDALONE_WASM -sFILESYSTEM=0
  -sINITIAL_MEMORY=16MB -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB)
set_target_properties(pillowmesh_wasm PROPERTIES
  OUTPUT_NAME pillowmesh SUFFIX .wasm RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
