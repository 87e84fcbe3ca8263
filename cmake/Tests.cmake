# One executable with all Catch2 suites; ctest runs its test cases one by one, so that a crash costs one test.
file(GLOB_RECURSE test_sources CONFIGURE_DEPENDS tests/core/*.cpp tests/paper/*.cpp tests/fuzz/*.cpp)
find_package(Catch2 REQUIRED)
include(Catch)

add_executable(pillowmesh_tests ${test_sources})
pillowmesh_compile_options(pillowmesh_tests)
# Most of the time that tests take is that of their compilation.
target_precompile_headers(pillowmesh_tests PRIVATE tests/catch.h core/pillowmesh/mesh/mesh.h)
pillowmesh_unite(pillowmesh_tests 12)
set_source_files_properties(tests/core/main.cpp PROPERTIES  # defines before it includes
  SKIP_PRECOMPILE_HEADERS ON SKIP_UNITY_BUILD_INCLUSION ON)
if(NOT MSVC)
  target_compile_options(pillowmesh_tests PRIVATE $<$<CONFIG:Release>:-O1>)
endif()
target_include_directories(pillowmesh_tests PRIVATE ${CMAKE_CURRENT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/tests)
target_compile_definitions(pillowmesh_tests PRIVATE
  PILLOWMESH_VERSION="${PROJECT_VERSION}"
  PILLOWMESH_TEST_DATA="${CMAKE_CURRENT_SOURCE_DIR}/tests/data")
target_link_libraries(pillowmesh_tests PRIVATE pillowmesh::core Catch2::Catch2)
catch_discover_tests(pillowmesh_tests)
