# The core behind a C interface (wasm/*_api.cpp), without generated JavaScript, in several modules, so that nobody
# downloads what he does not use (docs/decisions/0010-several-modules.md): build/wasm/pillowmesh.wasm for quadrilaterals by
# the paper's method, pillowmesh_full.wasm for their full adaptation too, pillowmesh3d.wasm for hexahedra,
# pillowmesh_files.wasm for file formats, pillowmesh_metrics.wasm for making metrics. The functions exported are those
# that the interfaces mark with PM_API.

# The page downloads this: what is not hot is compiled for size. Link-time optimisation takes another eighth off, and
# -Oz at the link keeps it from undoing the rest; the hot code keeps the speed of the -O2 that it is compiled with.
string(JOIN "|" hot
  "refine/(buffer_layer|hull|layer|vertex_copies)" "smooth/"
  "metric/(background|program_run|field|volume)" "adapt/(outlook|tagging)" "mesh/(foot|slide|topology)")
# The modules for hexahedra and for metrics have room for more. What is listed here is compiled once more for them: of an
# inline function that was not inlined, the linker keeps one copy for all callers, and it may be one from a source
# compiled with -Oz. (Making the metric of the portrait took 22 s without, most of it in one-line accessors.)
string(JOIN "|" hot_in_3d "adapt/adapter" "metric/length\\." "quality/shape")
string(JOIN "|" hot_in_metrics
  "metric/(gradation|image|intersection|nodal|portrait|simplex_tree|spectrum)")

# Moves the sources that match from `left` to `list`.
set(left ${core_sources})
macro(pillowmesh_take list pattern)
  set(${list} ${left})
  list(FILTER ${list} INCLUDE REGEX "${pattern}")
  list(REMOVE_ITEM left ${${list}})
endmacro()
# Sources that ask which dimensions there are (mesh/any_mesh.h), or which methods (adapt/options.h), are compiled for each
# module, the others once for all.
pillowmesh_take(by_dimension "pillowmesh/(io/io|mesh/primitives_parse)")
pillowmesh_take(by_method "pillowmesh/adapt/adapter")
pillowmesh_take(quick "pillowmesh/(${hot})|third_party")
pillowmesh_take(quick_in_3d "pillowmesh/(${hot_in_3d})")
pillowmesh_take(quick_in_metrics "pillowmesh/(${hot_in_metrics})")

# Object files for link-time optimisation; LEVEL is -O2 or -Oz.
function(pillowmesh_objects target level)
  add_library(${target} OBJECT ${ARGN})
  pillowmesh_compile_options(${target})
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/core)
  target_compile_definitions(${target} PRIVATE PILLOWMESH_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${target} PRIVATE Eigen3::Eigen)
  # Scalars packed into SIMD lanes one by one: with clang 14 the smoother of hexahedra takes twice the time, and
  # metric/background.cpp gives other numbers than native. Loops over lanes are vectorised all the same, but for those of
  # programs, which are unrolled before: there formulas with roots and quotients would take twice the time.
  target_compile_options(${target} PRIVATE ${level} -flto -fno-slp-vectorize
    $<$<COMPILE_LANGUAGE:CXX>:-fno-exceptions -fno-rtti>)
endfunction()
set_property(SOURCE core/pillowmesh/metric/program_run.cpp APPEND PROPERTY COMPILE_OPTIONS -fslp-vectorize)
# To start Emscripten's compiler takes longer than these small sources do. Those left out define what others define, too.
set(vendored ${quick})
list(FILTER vendored INCLUDE REGEX "\\.c$")
list(FILTER vendored EXCLUDE REGEX "/(__tan|asin|floor|pow)\\.c$")
set_source_files_properties(${vendored} PROPERTIES UNITY_GROUP vendored)

# As an archive, of which a module takes what it needs.
pillowmesh_objects(pillowmesh_quick -O2 ${quick})
pillowmesh_objects(pillowmesh_solid -Oz ${quick_in_3d})
pillowmesh_objects(pillowmesh_making -Oz ${quick_in_metrics})
pillowmesh_objects(pillowmesh_rest -Oz ${left})
set(parts pillowmesh_quick pillowmesh_solid pillowmesh_making pillowmesh_rest)
foreach(part ${parts})
  pillowmesh_unite(${part} 10)
endforeach()
list(TRANSFORM parts REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>")
set_target_properties(pillowmesh_core PROPERTIES SOURCES "${parts}" LINKER_LANGUAGE CXX)

# OUTPUT.wasm of SOURCES, compiled for size, and of QUICK.
function(pillowmesh_module target)
  cmake_parse_arguments(module "" "OUTPUT" "SOURCES;QUICK;DEFINITIONS" ${ARGN})
  set(objects)
  if(module_QUICK)
    pillowmesh_objects(${target}_quick -O2 ${module_QUICK})
    list(APPEND objects ${target}_quick)
  endif()
  pillowmesh_objects(${target}_own -Oz ${module_SOURCES} wasm/memory.cpp wasm/input_bytes.cpp)
  list(APPEND objects ${target}_own)
  foreach(part ${objects})
    target_compile_definitions(${part} PRIVATE ${module_DEFINITIONS})
    set_target_properties(${part} PROPERTIES UNITY_BUILD_MODE BATCH UNITY_BUILD_BATCH_SIZE 0)
  endforeach()
  # The copy of an inline function that the linker keeps is the first. Where there is little room those are from sources
  # compiled for size, which saves 2 %; what is hot has its own inlined.
  if(NOT module_QUICK)
    list(APPEND objects pillowmesh_rest pillowmesh_solid)
  endif()
  list(TRANSFORM objects REPLACE "(.+)" "$<TARGET_OBJECTS:\\1>")
  add_executable(${target} ${objects})
  target_link_libraries(${target} PRIVATE pillowmesh::core)
  target_link_options(${target} PRIVATE
    -Oz --no-entry -sSTANDALONE_WASM -sFILESYSTEM=0 -sMALLOC=emmalloc
    -sINITIAL_MEMORY=16MB -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB)
  set_target_properties(${target} PROPERTIES LINKER_LANGUAGE CXX
    OUTPUT_NAME ${module_OUTPUT} SUFFIX .wasm RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})
endfunction()

set(adapting wasm/c_api.cpp wasm/events.cpp wasm/nodal_bytes.cpp ${by_dimension})
pillowmesh_module(pillowmesh_wasm OUTPUT pillowmesh SOURCES ${adapting} ${by_method}
  DEFINITIONS PILLOWMESH_DIMENSION=2 PILLOWMESH_PAPER_ONLY)
pillowmesh_module(pillowmesh_wasm_full OUTPUT pillowmesh_full SOURCES ${adapting} ${by_method}
  DEFINITIONS PILLOWMESH_DIMENSION=2)
pillowmesh_module(pillowmesh_wasm3d OUTPUT pillowmesh3d SOURCES ${adapting} QUICK ${by_method} ${quick_in_3d}
  DEFINITIONS PILLOWMESH_DIMENSION=3)
pillowmesh_module(pillowmesh_wasm_files OUTPUT pillowmesh_files SOURCES wasm/files_api.cpp ${by_dimension})
pillowmesh_module(pillowmesh_wasm_metrics OUTPUT pillowmesh_metrics
  SOURCES wasm/metrics_api.cpp wasm/nodal_bytes.cpp ${by_dimension} QUICK ${quick_in_metrics})
