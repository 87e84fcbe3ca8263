# The core behind a C interface (wasm/*_api.cpp), without generated JavaScript, in several modules, so that nobody
# downloads what he does not use (docs/decisions/0010-several-modules.md): build/wasm/pillowmesh.wasm for quadrilaterals by
# the paper's method, pillowmesh_full.wasm for their full adaptation too, pillowmesh3d.wasm for hexahedra,
# pillowmesh_files.wasm for file formats. The functions exported are those that the
# interfaces mark with PM_API.
file(GLOB wasm_sources CONFIGURE_DEPENDS wasm/*.cpp)
if(NOT wasm_sources)
  return()
endif()

# The page downloads this: what is not hot is compiled for size. Link-time optimisation takes another eighth off, and
# -Oz at the link keeps it from undoing the rest; the hot code keeps the speed of the -O2 that it is compiled with.
string(JOIN "|" hot
  "refine/(balance|buffer_layer|edge_tags|hull|layer|tag_inheritance|untangle|vertex_copies)" "smooth/" "quality/shape"
  "metric/(background|gradation|intersection|program|field|length|volume)" "adapt/tagging" "mesh/(foot|slide|topology)")
foreach(source ${core_sources} ${wasm_sources})
  if(source MATCHES "pillowmesh/(${hot})|third_party")
    set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -O2 -flto)
  else()
    set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -Oz -flto)
  endif()
  # Scalars packed into SIMD lanes one by one: with clang 14 the smoother of hexahedra takes twice the time, and
  # metric/background.cpp gives other numbers than native. Loops over lanes are vectorised all the same.
  set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -fno-slp-vectorize)
endforeach()

# Sources that ask which dimensions there are (mesh/any_mesh.h), or which methods (adapt/options.h), are compiled for each
# module, the others once for all.
set(by_dimension ${core_sources})
list(FILTER by_dimension INCLUDE REGEX "pillowmesh/(io/io|mesh/primitives_parse)")
set(by_method ${core_sources})
list(FILTER by_method INCLUDE REGEX "pillowmesh/adapt/adapter")
set(shared ${core_sources})
list(REMOVE_ITEM shared ${by_dimension} ${by_method})
set_property(TARGET pillowmesh_core PROPERTY SOURCES ${shared})

function(pillowmesh_module target)
  cmake_parse_arguments(module "" "OUTPUT" "SOURCES;DEFINITIONS" ${ARGN})
  add_executable(${target} ${module_SOURCES} wasm/memory.cpp wasm/input_bytes.cpp)
  pillowmesh_compile_options(${target})
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
  target_compile_definitions(${target} PRIVATE PILLOWMESH_VERSION="${PROJECT_VERSION}" ${module_DEFINITIONS})
  target_compile_options(${target} PRIVATE -fno-exceptions -fno-rtti)
  target_link_libraries(${target} PRIVATE pillowmesh::core)
  target_link_options(${target} PRIVATE
    -Oz --no-entry -sSTANDALONE_WASM -sFILESYSTEM=0 -sMALLOC=emmalloc
    -sINITIAL_MEMORY=16MB -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB)
  set_target_properties(${target} PROPERTIES
    OUTPUT_NAME ${module_OUTPUT} SUFFIX .wasm RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
endfunction()

set(adapting wasm/c_api.cpp wasm/events.cpp wasm/nodal_bytes.cpp ${by_dimension} ${by_method})
pillowmesh_module(pillowmesh_wasm OUTPUT pillowmesh SOURCES ${adapting}
  DEFINITIONS PILLOWMESH_DIMENSION=2 PILLOWMESH_PAPER_ONLY)
pillowmesh_module(pillowmesh_wasm_full OUTPUT pillowmesh_full SOURCES ${adapting} DEFINITIONS PILLOWMESH_DIMENSION=2)
pillowmesh_module(pillowmesh_wasm3d OUTPUT pillowmesh3d SOURCES ${adapting} DEFINITIONS PILLOWMESH_DIMENSION=3)
pillowmesh_module(pillowmesh_wasm_files OUTPUT pillowmesh_files SOURCES wasm/files_api.cpp ${by_dimension})
pillowmesh_module(pillowmesh_wasm_metrics OUTPUT pillowmesh_metrics
  SOURCES wasm/metrics_api.cpp wasm/nodal_bytes.cpp ${by_dimension})
