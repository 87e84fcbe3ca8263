// The meshes of others that lie beside the project, where they are: see ../shared/data/README.md.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

namespace shared_data {

/// The folder: the environment variable PILLOWMESH_SHARED_DATA, or ../shared/data beside the sources.
inline std::string folder() {
  const char* named = std::getenv("PILLOWMESH_SHARED_DATA");
  return named != nullptr ? named : PILLOWMESH_TEST_DATA "/../../../shared/data";
}

/// The path of a file of that folder, or "" after having said that the test is skipped.
inline std::string path(const std::string& name) {
  std::string file = folder() + "/" + name;
  if (std::FILE* opened = std::fopen(file.c_str(), "rb")) {
    std::fclose(opened);
    return file;
  }
  std::printf("skipped: no ../shared/data (%s)\n", name.c_str());
  return "";
}

}  // namespace shared_data
