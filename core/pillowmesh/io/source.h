// A mesh file in memory, read word by word (text) or value by value (binary). The first failure sticks.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "pillowmesh/mesh/status.h"

namespace pillowmesh {

/// A piece of a file as a message may show it: short, printable, in quotes.
std::string quoted(std::string_view piece);

/// After a failure every read returns 0 or an empty word, so that readers check once per section, not per value.
class Source {
 public:
  /// `comment`: text from this character to the end of the line is skipped; '\0' for none.
  Source(std::string_view name, std::span<const char> bytes, char comment = '\0')
      : name_(name), data_(bytes.data()), size_(bytes.size()), comment_(comment) {}

  /// From here on `value`, `integer` and `real` read binary values; `swapped`: in the other byte order.
  void set_binary(bool swapped) {
    binary_ = true;
    binary_file_ = true;
    swapped_ = swapped;
  }
  /// For text inside of a binary file: true switches to text, false back to binary values.
  void set_text(bool text) { binary_ = !text; }
  [[nodiscard]] bool binary() const { return binary_; }

  [[nodiscard]] bool failed() const { return !status_.ok(); }
  [[nodiscard]] const Status& status() const { return status_; }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Records `name, line N: reason` (binary: byte N). Only the first failure counts.
  void fail(const std::string& reason) { fail_at(binary_file_ ? static_cast<std::int64_t>(position_) : line_, reason); }
  void fail_at(std::int64_t place, const std::string& reason);
  /// Records `name: reason`.
  void fail_whole(const std::string& reason);

  /// Next word between white space; empty at the end of the file.
  std::string_view word();
  /// What is left of the current line, without its end; the position moves to the next line.
  std::string_view rest_of_line();
  /// Line (from 1) of the word read last.
  [[nodiscard]] std::int64_t line() const { return line_; }

  /// Next integer, as text or as a binary value of type T. `what` names it in a message: "a vertex number".
  template <class T = std::int32_t>
  std::int64_t integer(const char* what) {
    return binary_ ? static_cast<std::int64_t>(value<T>(what)) : text_integer(what);
  }
  /// Next number, as text or as a binary value of type T.
  template <class T = double>
  double real(const char* what) {
    return binary_ ? static_cast<double>(value<T>(what)) : text_real(what);
  }
  /// Next binary value.
  template <class T>
  T value(const char* what) {
    T result{};
    if (remaining() < sizeof(T)) {
      fail_end(what);
      return result;
    }
    char bytes[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes[swapped_ ? sizeof(T) - 1 - i : i] = data_[position_ + i];
    std::memcpy(&result, bytes, sizeof(T));
    position_ += sizeof(T);
    return result;
  }
  /// Reads a count of `things` that take at least `unit` numbers (text) or bytes (binary) each, and refuses one that
  /// the rest of the file cannot hold: a file must not make its reader allocate more than a multiple of its size.
  template <class T = std::int32_t>
  std::int64_t count(const char* things, std::int64_t unit) {
    return checked_count(integer<T>("a count"), things, unit);
  }
  std::int64_t checked_count(std::int64_t count, const char* things, std::int64_t unit);

  [[nodiscard]] std::size_t position() const { return position_; }
  [[nodiscard]] std::size_t remaining() const { return size_ - position_; }
  [[nodiscard]] std::string_view view(std::size_t from, std::size_t length) const { return {data_ + from, length}; }
  /// Moves to a byte; lines passed are counted when `counting` (text).
  void seek(std::size_t position, bool counting = false);
  /// Where `reset` can go back to.
  struct Mark {
    std::size_t position;
    std::int64_t next_line;
  };
  [[nodiscard]] Mark mark() const { return {position_, next_line_}; }
  void reset(Mark m) {
    if (failed()) return;
    position_ = m.position;
    next_line_ = m.next_line;
  }
  /// Position of `text` at or after the current position, or npos.
  [[nodiscard]] std::size_t find(std::string_view text) const {
    return std::string_view(data_, size_).find(text, position_);
  }
  /// Line (from 1) of a byte. Cost: linear.
  [[nodiscard]] std::int64_t line_of(std::size_t position) const;

 private:
  std::int64_t text_integer(const char* what);
  double text_real(const char* what);
  void fail_end(const char* what);
  void fail_word(const char* what, std::string_view found);

  std::string name_;
  const char* data_;
  std::size_t size_;
  std::size_t position_ = 0;
  std::int64_t line_ = 1;       // of the last word
  std::int64_t next_line_ = 1;  // at position_
  char comment_;
  bool binary_ = false;       // how the next value is read
  bool binary_file_ = false;  // messages give bytes, not lines
  bool swapped_ = false;
  Status status_;
};

}  // namespace pillowmesh
