# build/wasm/pillowmesh.wasm: the core behind a C ABI (wasm/c_api.cpp), without generated JavaScript. The functions
# exported are those that c_api.cpp marks with export_name or EMSCRIPTEN_KEEPALIVE.
file(GLOB wasm_sources CONFIGURE_DEPENDS wasm/*.cpp)
if(NOT wasm_sources)
  return()
endif()

# The page downloads this: what is not hot is compiled for size. Link-time optimisation takes another eighth off, and
# -Oz at the link keeps it from undoing the rest; the hot code keeps the speed of the -O2 that it is compiled with.
string(JOIN "|" hot
  "refine/" "smooth/" "quality/" "metric/(program|field|length|volume)" "adapt/(adapter|tagging)" "mesh/(slide|topology)")
foreach(source ${core_sources} ${wasm_sources})
  if(source MATCHES "pillowmesh/(${hot})|third_party")
    set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -O2 -flto)
  else()
    set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -Oz -flto)
  endif()
endforeach()

add_executable(pillowmesh_wasm ${wasm_sources})
pillowmesh_compile_options(pillowmesh_wasm)
target_include_directories(pillowmesh_wasm PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_compile_definitions(pillowmesh_wasm PRIVATE PILLOWMESH_VERSION="${PROJECT_VERSION}")
target_compile_options(pillowmesh_wasm PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-fno-exceptions -fno-rtti>)
target_link_libraries(pillowmesh_wasm PRIVATE pillowmesh::core)
target_link_options(pillowmesh_wasm PRIVATE
  -Oz --no-entry -sSTANDALONE_WASM -sFILESYSTEM=0
  -sINITIAL_MEMORY=16MB -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB)
set_target_properties(pillowmesh_wasm PROPERTIES
  OUTPUT_NAME pillowmesh SUFFIX .wasm RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
