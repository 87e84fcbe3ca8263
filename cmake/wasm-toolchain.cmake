# Finds emcc (Debian's package, or an emsdk on PATH) and hands over to its own toolchain file.
find_program(PILLOWMESH_EMCC emcc HINTS $ENV{EMSDK}/upstream/emscripten REQUIRED)
get_filename_component(emcc_real ${PILLOWMESH_EMCC} REALPATH)
get_filename_component(emscripten_root ${emcc_real} DIRECTORY)
include(${emscripten_root}/cmake/Modules/Platform/Emscripten.cmake)
# Eigen is headers only: the host's copy serves.
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)
