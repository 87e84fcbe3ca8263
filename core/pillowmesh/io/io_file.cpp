#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>
#include <vector>

#include "pillowmesh/io/io.h"
#include "pillowmesh/io/sink.h"

namespace pillowmesh {
namespace {

std::string system_reason() { return std::strerror(errno); }

/// Opens a new file beside `path`, lets `fill` write it, and renames it to `path`.
template <class Fill>
Status write_safely(const std::string& path, Fill&& fill) {
  std::string temporary;
  std::FILE* file = nullptr;
  for (int i = 0; i < 100 && file == nullptr; ++i) {
    temporary = path + ".part" + std::to_string(i);
    file = std::fopen(temporary.c_str(), "wbx");
    if (file == nullptr && errno != EEXIST) break;
  }
  if (file == nullptr) return Status::bad_input(path + ": cannot be written: " + system_reason());
  Sink sink(
      [](void* to, std::string_view bytes) {
        return std::fwrite(bytes.data(), 1, bytes.size(), static_cast<std::FILE*>(to)) == bytes.size();
      },
      file);
  Status status = fill(sink);
  std::string reason;
  if (status.ok() && !sink.flush()) reason = system_reason();
  if (std::fclose(file) != 0 && reason.empty()) reason = system_reason();
  if (status.ok() && reason.empty() && std::rename(temporary.c_str(), path.c_str()) != 0) reason = system_reason();
  if (status.ok() && reason.empty()) return {};
  std::remove(temporary.c_str());
  return status.ok() ? Status::bad_input(path + ": cannot be written: " + reason) : status;
}

}  // namespace

Expected<std::vector<char>> read_file(const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) return Status::bad_input(path + ": cannot be read: " + system_reason());
  long size = 0;
  if (std::fseek(file, 0, SEEK_END) == 0) size = std::ftell(file);
  std::rewind(file);
  std::vector<char> bytes;
  char chunk[1 << 16];
  std::size_t n = 0;
  errno = 0;
  while ((n = std::fread(chunk, 1, sizeof chunk, file)) > 0) {
    // Not before something has been read: a folder claims to be endless.
    if (bytes.empty() && size > 0) bytes.reserve(static_cast<std::size_t>(size));
    bytes.insert(bytes.end(), chunk, chunk + n);
  }
  const bool failed = std::ferror(file) != 0;
  const std::string reason = failed ? system_reason() : "";
  std::fclose(file);
  if (failed) return Status::bad_input(path + ": cannot be read: " + reason);
  return bytes;
}

Expected<AnyMesh> read_mesh_file(const std::string& path, const BoundaryOptions& options) {
  if (Status s = check_writable(path); !s.ok()) return Status::bad_input(s.message);  // unknown ending
  auto bytes = read_file(path);
  if (!bytes) return bytes.status();
  return read_mesh(path, *bytes, options);
}

template <int Dim>
Status write_mesh_file(const Mesh<Dim>& mesh, const std::string& path, const WriteOptions& options,
                       std::vector<FieldArray> fields) {
  if (Status s = check_writable(path, options); !s.ok()) return s;
  return write_safely(path, [&](Sink& sink) { return write_mesh_to(sink, mesh, path, options, std::move(fields)); });
}

Status write_mesh_file(const AnyMesh& mesh, const std::string& path, const WriteOptions& options) {
  return std::visit([&](const auto& m) { return write_mesh_file(m, path, options); }, mesh);
}

Status write_text_file(std::string_view text, const std::string& path) {
  return write_safely(path, [&](Sink& sink) {
    sink << text;
    return Status{};
  });
}

template Status write_mesh_file(const Mesh<2>&, const std::string&, const WriteOptions&, std::vector<FieldArray>);
template Status write_mesh_file(const Mesh<3>&, const std::string&, const WriteOptions&, std::vector<FieldArray>);

}  // namespace pillowmesh
