#include "files_api.h"

#include <string>
#include <utility>
#include <variant>

#include "input_bytes.h"
#include "pillowmesh/io/io.h"

using namespace pillowmesh;

struct pm_files {
  Status last;
  std::string bytes;
  int dimension = 0;

  pm_status finish(Expected<std::string> result) {
    bytes = result ? std::move(*result) : std::string();
    last = result.status();
    return static_cast<pm_status>(last.code);
  }
};

namespace {

template <int Dim>
Expected<std::string> as_file(std::string_view name, std::span<const char> bytes) {
  auto input = from_bytes<Dim>(bytes);
  if (!input) return input.status();
  return write_input(std::move(*input), name);
}

}  // namespace

extern "C" {

pm_files* pm_files_create(void) { return new pm_files; }
void pm_files_destroy(pm_files* files) { delete files; }
const char* pm_files_message(const pm_files* files) { return files->last.message.c_str(); }
const char* pm_files_bytes(const pm_files* files) { return files->bytes.data(); }
uint32_t pm_files_byte_count(const pm_files* files) { return static_cast<uint32_t>(files->bytes.size()); }
int32_t pm_files_dimension(const pm_files* files) { return files->dimension; }

pm_status pm_files_read(pm_files* files, const char* name, uint32_t name_size, const char* bytes, uint32_t size) {
  const auto input = read_input({name, name_size}, {bytes, size});
  if (!input) return files->finish(input.status());
  files->dimension = input->index() == 0 ? 2 : 3;
  return files->finish(std::visit([](const auto& i) { return to_bytes(i); }, *input));
}

pm_status pm_files_write(pm_files* files, const char* name, uint32_t name_size, const char* bytes, uint32_t size) {
  const auto convert = dimension_of({bytes, size}) == 3 ? as_file<3> : as_file<2>;
  if (dimension_of({bytes, size}) == 0) return files->finish(Status::usage("These are not the bytes of a mesh."));
  return files->finish(convert({name, name_size}, {bytes, size}));
}

}  // extern "C"
