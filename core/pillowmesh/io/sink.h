// Where writers put their bytes: a string, or a file through a buffer, so that memory does not grow with the mesh.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "pillowmesh/mesh/number.h"

namespace pillowmesh {

class Sink {
 public:
  /// To a string: see `take`.
  Sink() = default;
  /// Hands the bytes to `write` (which returns false when it fails), about a megabyte at a time. A function pointer,
  /// so that writing to memory, all that wasm does, does not link the system's files.
  using Write = bool (*)(void* to, std::string_view bytes);
  Sink(Write write, void* to) : write_(write), to_(to) {}

  Sink& operator<<(std::string_view text) {
    buffer_.append(text);
    if (buffer_.size() >= kFlushSize) flush();
    return *this;
  }
  Sink& operator<<(char c) {
    buffer_.push_back(c);
    return *this;
  }
  Sink& operator<<(double value) {
    char text[kNumberLength];
    return *this << std::string_view(text, static_cast<std::size_t>(format_double(value, text)));
  }
  Sink& operator<<(std::int64_t value) {
    char text[kNumberLength];
    return *this << std::string_view(text, static_cast<std::size_t>(format_integer(value, text)));
  }
  Sink& operator<<(std::int32_t value) { return *this << static_cast<std::int64_t>(value); }
  Sink& operator<<(std::size_t value) { return *this << static_cast<std::int64_t>(value); }
  Sink& operator<<(const char* text) { return *this << std::string_view(text); }

  /// The value's bytes in memory order.
  template <class T>
  void raw(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    *this << std::string_view(bytes, sizeof(T));
  }

  /// Writes what is buffered. \return false when any write failed.
  bool flush() {
    if (write_ == nullptr) return true;
    good_ = write_(to_, buffer_) && good_;
    buffer_.clear();
    return good_;
  }
  /// The bytes written so far, when they go to a string.
  std::string take() { return std::move(buffer_); }

 private:
  static constexpr std::size_t kFlushSize = std::size_t{1} << 20;
  std::string buffer_;
  Write write_ = nullptr;
  void* to_ = nullptr;
  bool good_ = true;
};

}  // namespace pillowmesh
