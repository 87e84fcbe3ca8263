// Inflate after RFC 1951; canonical Huffman decoding by counts per length, as in Mark Adler's puff.
#include "pillowmesh/io/codec.h"

#include <array>
#include <cstdint>

namespace pillowmesh {

bool decode_base64(std::string_view text, std::size_t limit, std::string& bytes) {
  const std::size_t target = bytes.size() + limit;
  std::uint32_t group = 0;
  int held = 0;
  for (char c : text) {
    if (bytes.size() >= target) break;
    std::uint32_t digit = 0;
    if (c >= 'A' && c <= 'Z') {
      digit = static_cast<std::uint32_t>(c - 'A');
    } else if (c >= 'a' && c <= 'z') {
      digit = static_cast<std::uint32_t>(c - 'a') + 26;
    } else if (c >= '0' && c <= '9') {
      digit = static_cast<std::uint32_t>(c - '0') + 52;
    } else if (c == '+') {
      digit = 62;
    } else if (c == '/') {
      digit = 63;
    } else if (c == '=') {
      // End of a piece: two digits left give one byte, three give two.
      for (int i = 0; i < held - 1 && bytes.size() < target; ++i)
        bytes.push_back(static_cast<char>(group >> (6 * held - 8 * (i + 1)) & 0xff));
      group = 0;
      held = 0;
      continue;
    } else if (c == ' ' || (c >= '\t' && c <= '\r')) {
      continue;
    } else {
      return false;
    }
    group = group << 6 | digit;
    if (++held == 4) {
      for (int i = 0; i < 3 && bytes.size() < target; ++i)
        bytes.push_back(static_cast<char>(group >> (16 - 8 * i) & 0xff));
      group = 0;
      held = 0;
    }
  }
  return true;
}

namespace {

constexpr int kMaxBits = 15;

class Bits {
 public:
  explicit Bits(std::string_view data) : data_(data) {}
  /// Next n <= 16 bits; sets `failed` past the end.
  unsigned take(int n) {
    while (held_ < n) {
      if (at_ >= data_.size()) {
        failed = true;
        return 0;
      }
      bits_ |= static_cast<std::uint32_t>(static_cast<unsigned char>(data_[at_++])) << held_;
      held_ += 8;
    }
    const unsigned value = bits_ & ((1u << n) - 1);
    bits_ >>= n;
    held_ -= n;
    return value;
  }
  /// `n` whole bytes from the next byte boundary on.
  std::string_view bytes(std::size_t n) {
    bits_ = 0;
    held_ = 0;
    if (data_.size() - at_ < n) {
      failed = true;
      return {};
    }
    at_ += n;
    return data_.substr(at_ - n, n);
  }
  bool failed = false;

 private:
  std::string_view data_;
  std::size_t at_ = 0;
  std::uint32_t bits_ = 0;
  int held_ = 0;
};

/// Canonical Huffman code: how many codes of each length, and the symbols in code order.
struct Huffman {
  std::array<std::uint16_t, kMaxBits + 1> count{};
  std::array<std::uint16_t, 288> symbol{};

  /// \return false when the lengths promise more codes than there are.
  bool build(const std::uint8_t* lengths, int n) {
    count.fill(0);
    for (int i = 0; i < n; ++i) ++count[lengths[i]];
    count[0] = 0;
    int left = 1;
    for (int bits = 1; bits <= kMaxBits; ++bits) {
      left = 2 * left - count[bits];
      if (left < 0) return false;
    }
    std::array<std::uint16_t, kMaxBits + 2> offset{};
    for (int bits = 1; bits <= kMaxBits; ++bits)
      offset[bits + 1] = static_cast<std::uint16_t>(offset[bits] + count[bits]);
    for (int i = 0; i < n; ++i)
      if (lengths[i] != 0) symbol[offset[lengths[i]]++] = static_cast<std::uint16_t>(i);
    return true;
  }
  /// -1 for a code that does not exist.
  int decode(Bits& in) const {
    int code = 0, first = 0, index = 0;
    for (int bits = 1; bits <= kMaxBits; ++bits) {
      code |= static_cast<int>(in.take(1));
      if (in.failed) return -1;
      if (code - count[bits] < first) return symbol[static_cast<std::size_t>(index + (code - first))];
      index += count[bits];
      first = (first + count[bits]) << 1;
      code <<= 1;
    }
    return -1;
  }
};

/// Reads the code lengths of a dynamic block.
bool read_codes(Bits& in, Huffman& literals, Huffman& distances) {
  constexpr std::uint8_t order[19] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
  const int n_literals = static_cast<int>(in.take(5)) + 257;
  const int n_distances = static_cast<int>(in.take(5)) + 1;
  const int n_lengths = static_cast<int>(in.take(4)) + 4;
  if (in.failed || n_literals > 286 || n_distances > 30) return false;
  std::uint8_t lengths[320] = {};
  for (int i = 0; i < n_lengths; ++i) lengths[order[i]] = static_cast<std::uint8_t>(in.take(3));
  Huffman codes;
  if (in.failed || !codes.build(lengths, 19)) return false;
  std::uint8_t all[320] = {};
  for (int i = 0; i < n_literals + n_distances;) {
    const int symbol = codes.decode(in);
    if (symbol < 0) return false;
    if (symbol < 16) {
      all[i++] = static_cast<std::uint8_t>(symbol);
      continue;
    }
    if (symbol == 16 && i == 0) return false;
    const std::uint8_t value = symbol == 16 ? all[i - 1] : 0;
    const int repeat = static_cast<int>(symbol == 16   ? 3 + in.take(2)
                                        : symbol == 17 ? 3 + in.take(3)
                                                       : 11 + in.take(7));
    if (in.failed || i + repeat > n_literals + n_distances) return false;
    for (int k = 0; k < repeat; ++k) all[i++] = value;
  }
  return literals.build(all, n_literals) && distances.build(all + n_literals, n_distances);
}

/// The symbols of one block. `start`: where the stream's output begins, `target`: where it must end at the latest.
bool expand(Bits& in, const Huffman& literals, const Huffman& distances, std::size_t start, std::size_t target,
            std::string& out) {
  constexpr std::uint16_t length_base[29] = {3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                             31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
  constexpr std::uint8_t length_extra[29] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                             2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
  constexpr std::uint16_t distance_base[30] = {1,    2,    3,    4,    5,    7,    9,    13,    17,    25,
                                               33,   49,   65,   97,   129,  193,  257,  385,   513,   769,
                                               1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
  for (;;) {
    const int symbol = literals.decode(in);
    if (symbol < 0 || symbol > 285) return false;
    if (symbol == 256) return true;
    if (symbol < 256) {
      if (out.size() >= target) return false;
      out.push_back(static_cast<char>(symbol));
      continue;
    }
    const std::size_t length = length_base[symbol - 257] + in.take(length_extra[symbol - 257]);
    const int code = distances.decode(in);
    if (code < 0 || code > 29) return false;
    const std::size_t distance = distance_base[code] + in.take(code < 2 ? 0 : code / 2 - 1);
    if (in.failed || distance > out.size() - start || length > target - out.size()) return false;
    for (std::size_t i = 0; i < length; ++i) out.push_back(out[out.size() - distance]);
  }
}

}  // namespace

bool inflate_zlib(std::string_view stream, std::size_t limit, std::string& out) {
  if (stream.size() < 2 || (stream[0] & 0x0f) != 8 || (stream[1] & 0x20) != 0) return false;
  Bits in(stream.substr(2));
  const std::size_t start = out.size();
  const std::size_t target = start + limit;
  for (bool last = false; !last;) {
    last = in.take(1) != 0;
    const unsigned kind = in.take(2);
    if (in.failed || kind == 3) return false;
    if (kind == 0) {
      const std::string_view header = in.bytes(4);
      if (in.failed) return false;
      const std::size_t n = static_cast<unsigned char>(header[0]) | static_cast<unsigned char>(header[1]) << 8;
      const std::string_view bytes = in.bytes(n);
      if (in.failed || n > target - out.size()) return false;
      out.append(bytes);
      continue;
    }
    Huffman literals, distances;
    if (kind == 1) {
      std::uint8_t lengths[288];
      for (int i = 0; i < 288; ++i) lengths[i] = i < 144 ? 8 : i < 256 ? 9 : i < 280 ? 7 : 8;
      literals.build(lengths, 288);
      for (int i = 0; i < 30; ++i) lengths[i] = 5;
      distances.build(lengths, 30);
    } else if (!read_codes(in, literals, distances)) {
      return false;
    }
    if (!expand(in, literals, distances, start, target, out)) return false;
  }
  return true;
}

}  // namespace pillowmesh
