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
  "metric/(background|program|field|length|volume)" "adapt/tagging" "mesh/(foot|slide|topology)")
# The modules for hexahedra and for metrics have room for more. What is listed here is compiled once more for them: of an
# inline function that was not inlined, the linker keeps one copy for all callers, and it may be one from a source
# compiled with -Oz. (Making the metric of the portrait took 22 s without, most of it in one-line accessors.)
string(JOIN "|" hot_in_3d "adapt/(adapter|longest_edge|recorder)" "mesh/validate" "quality/")
string(JOIN "|" hot_in_metrics
  "metric/(gradation|image|intersection|nodal|portrait|simplex_tree|spectrum)")
set(fast_in_3d)
set(fast_in_metrics)
foreach(source ${core_sources} ${wasm_sources})
  if(source MATCHES "pillowmesh/(${hot})|third_party")
    set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -O2 -flto)
  elseif(source MATCHES "pillowmesh/(${hot_in_3d})")
    list(APPEND fast_in_3d ${source})
    set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS
      $<IF:$<STREQUAL:$<TARGET_PROPERTY:OUTPUT_NAME>,pillowmesh3d>,-O2,-Oz> -flto)
  elseif(source MATCHES "pillowmesh/(${hot_in_metrics})")
    list(APPEND fast_in_metrics ${source})
    set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS
      $<IF:$<STREQUAL:$<TARGET_PROPERTY:OUTPUT_NAME>,pillowmesh_metrics>,-O2,-Oz> -flto)
  else()
    set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -Oz -flto)
  endif()
  # Scalars packed into SIMD lanes one by one: with clang 14 the smoother of hexahedra takes twice the time, and
  # metric/background.cpp gives other numbers than native. Loops over lanes are vectorised all the same, but for those of
  # programs, which are unrolled before: there formulas with roots and quotients would take twice the time.
  if(NOT source MATCHES "metric/program_run")
    set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS -fno-slp-vectorize)
  endif()
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
set(adapting_in_3d ${fast_in_3d} ${adapting})
list(REMOVE_DUPLICATES adapting_in_3d)
pillowmesh_module(pillowmesh_wasm OUTPUT pillowmesh SOURCES ${adapting}
  DEFINITIONS PILLOWMESH_DIMENSION=2 PILLOWMESH_PAPER_ONLY)
pillowmesh_module(pillowmesh_wasm_full OUTPUT pillowmesh_full SOURCES ${adapting} DEFINITIONS PILLOWMESH_DIMENSION=2)
pillowmesh_module(pillowmesh_wasm3d OUTPUT pillowmesh3d SOURCES ${adapting_in_3d} DEFINITIONS PILLOWMESH_DIMENSION=3)
pillowmesh_module(pillowmesh_wasm_files OUTPUT pillowmesh_files SOURCES wasm/files_api.cpp ${by_dimension})
pillowmesh_module(pillowmesh_wasm_metrics OUTPUT pillowmesh_metrics
  SOURCES wasm/metrics_api.cpp wasm/nodal_bytes.cpp ${fast_in_metrics} ${by_dimension})
