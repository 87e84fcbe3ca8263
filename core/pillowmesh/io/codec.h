// The encodings of binary data inside of .vtu files: base64, and zlib's deflate (reading only).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pillowmesh {

/// Decodes base64 until `limit` bytes are there or `text` ends; white space is skipped. Pieces that were encoded one
/// after the other, each with its own padding, decode to their concatenation.
/// \return false at a character that is not base64.
bool decode_base64(std::string_view text, std::size_t limit, std::string& bytes);

/// Encodes a stream: whole groups of three bytes as they come, the rest at `finish`.
class Base64Encoder {
 public:
  /// Appends the characters for `count` more bytes to `out` (anything with operator<<(char)).
  template <class Out>
  void add(Out& out, const char* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      group_ = group_ << 8 | static_cast<unsigned char>(bytes[i]);
      if (++held_ == 3) {
        put(out, 4);
        group_ = 0;
        held_ = 0;
      }
    }
  }
  template <class Out>
  void finish(Out& out) {
    if (held_ == 0) return;
    group_ <<= 8 * (3 - held_);
    put(out, held_ + 1);
    for (int i = held_ + 1; i < 4; ++i) out << '=';
    group_ = 0;
    held_ = 0;
  }

 private:
  template <class Out>
  void put(Out& out, int characters) const {
    constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (int i = 0; i < characters; ++i) out << alphabet[group_ >> (18 - 6 * i) & 63];
  }
  unsigned group_ = 0;
  int held_ = 0;
};

/// Expands one zlib stream (RFC 1950, 1951) onto the end of `out`, by `limit` bytes at the most. Memory grows only with
/// what the stream really holds. The checksum is not verified.
/// \return false when the stream is malformed, cut short or longer than `limit`.
bool inflate_zlib(std::string_view stream, std::size_t limit, std::string& out);

}  // namespace pillowmesh
