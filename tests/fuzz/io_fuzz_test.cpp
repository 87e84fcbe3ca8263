// Damaged files: whatever the bytes, a reader returns a valid mesh or refuses with one sentence. It never crashes,
// hangs or asks for memory that its file does not justify. The sanitizers of the preset `dev` watch too.
//
// The same seed gives the same files. PILLOWMESH_FUZZ_SEED and PILLOWMESH_FUZZ_ROUNDS (default 1) look further.
#include <sys/resource.h>

#include <cstdlib>
#include <random>

#include "../catch.h"
#include "../core/io_meshes.h"
#include "pillowmesh/mesh/validate.h"

namespace io_fuzz_test {

using namespace pillowmesh;
using namespace io_test;

namespace {

unsigned long number_from(const char* variable, unsigned long otherwise) {
  const char* text = std::getenv(variable);
  return text != nullptr ? std::strtoul(text, nullptr, 10) : otherwise;
}

/// Allows a gigabyte more address space than is in use; an allocation beyond it throws. Not with AddressSanitizer,
/// which needs terabytes of address space and has a limit of its own.
class MemoryLimit {
 public:
  MemoryLimit() {
#if !defined(__SANITIZE_ADDRESS__)
    getrlimit(RLIMIT_AS, &before_);
    struct rlimit limit = before_;
    limit.rlim_cur = rlim_t{3} << 29;
    setrlimit(RLIMIT_AS, &limit);
#endif
  }
  ~MemoryLimit() {
#if !defined(__SANITIZE_ADDRESS__)
    setrlimit(RLIMIT_AS, &before_);
#endif
  }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  struct rlimit before_ = {};
};

class Mutator {
 public:
  explicit Mutator(unsigned long seed) : random_(seed) {}

  std::string operator()(std::string bytes) {
    const int changes = 1 + static_cast<int>(below(3));
    for (int i = 0; i < changes && !bytes.empty(); ++i) change(bytes);
    return bytes;
  }

 private:
  // Not std::uniform_int_distribution, which differs between standard libraries.
  std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random_() % n); }

  void change(std::string& bytes) {
    const std::size_t at = below(bytes.size());
    const std::size_t length = std::min(1 + below(40), bytes.size() - at);
    switch (below(8)) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 2:
        bytes[at] = static_cast<char>(random_());
        break;
      case 3:
        bytes.insert(at, bytes, at, length);
        break;
      case 4:
        bytes.erase(at, length);
        break;
      case 5: {  // another value where numbers are likely: four bytes of a binary file
        static constexpr std::int32_t values[] = {0, -1, 1, 0x7fffffff, -0x7fffffff - 1, 0x00ffffff, 1 << 24, 255};
        for (std::size_t k = 0; k < 4 && at + k < bytes.size(); ++k)
          bytes[at + k] = static_cast<char>(values[below(8)] >> (8 * k));
        break;
      }
      case 6:
        replace_word(bytes, at);
        break;
      default: {
        const std::size_t other = below(bytes.size() - length + 1);
        for (std::size_t k = 0; k < length; ++k) std::swap(bytes[at + k], bytes[other + k]);
      }
    }
  }

  /// Puts a troublesome word in the place of the one at or after `at`.
  void replace_word(std::string& bytes, std::size_t at) {
    static constexpr const char* words[] = {"-1", "0",    "99999999999", "4294967296", "-2147483648", "1e999", "nan",
                                            "-",  "1e",   "2147483647",  "3",          "End",         "<",     ">",
                                            "\"", "$End", "0x10",        "1000000000", "8",           "9"};
    const char* spaces = " \n\t\"<>=";
    std::size_t from = bytes.find_first_not_of(spaces, at);
    if (from == std::string::npos) return;
    while (from > 0 && std::string_view(spaces).find(bytes[from - 1]) == std::string_view::npos) --from;
    const std::size_t to = std::min(bytes.find_first_of(spaces, from), bytes.size());
    bytes.replace(from, to - from, words[below(std::size(words))]);
  }

  std::mt19937_64 random_;
};

/// Empty when the reader did what it should.
std::string misbehaviour(const std::string& name, const std::string& bytes, int& accepted) {
  const auto mesh = read_mesh(name, bytes);
  if (mesh.ok()) {
    ++accepted;
    const Status valid = std::visit([](const auto& m) { return validate(m); }, *mesh);
    return valid.ok() ? "" : "accepted a mesh that is not valid: " + valid.message;
  }
  const std::string& message = mesh.status().message;
  if (mesh.status().code != StatusCode::bad_input) return "refused, but not as bad input: " + message;
  if (!message.starts_with(name)) return "the message does not begin with the file: " + message;
  if (message.find('\n') != std::string::npos) return "the message has several lines: " + message;
  return "";
}

void check_damaged(const std::string& name, const std::string& bytes, unsigned long seed, int tries) {
  Mutator mutate(seed);
  int accepted = 0;
  for (int i = 0; i < tries; ++i) {
    const std::string damaged = mutate(bytes);
    const std::string wrong = misbehaviour(name, damaged, accepted);
    if (!wrong.empty()) {
      CAPTURE(name, seed, i, damaged);
      FAIL(wrong);
    }
  }
  CHECK(accepted < tries);
}

}  // namespace

TEST_CASE("Readers survive damaged files of every format", "[fuzz]") {
  const unsigned long seed = number_from("PILLOWMESH_FUZZ_SEED", 1);
  const int tries = 2000 * static_cast<int>(number_from("PILLOWMESH_FUZZ_ROUNDS", 1));
  WARN("PILLOWMESH_FUZZ_SEED=" << seed);
  const MemoryLimit limit;
  for (const Variant& v : all_variants()) {
    check_damaged(v.name, *write_mesh(grouped_mesh<2>(), v.name, v.options), seed, tries);
    check_damaged(v.name, *write_mesh(grouped_mesh<3>(), v.name, v.options), seed, tries);
  }
  for (const char* name : {"lshape_v2.msh", "lshape_v4.msh", "mixed_tri_quad_v2.msh"})
    check_damaged(name, read_data(name), seed, tries);
}

TEST_CASE("Readers survive files of one format under the name of another", "[fuzz]") {
  const MemoryLimit limit;
  int accepted = 0;
  for (const Variant& wrong : all_variants())
    for (const Variant& v : all_variants())
      CHECK(misbehaviour(wrong.name, *write_mesh(grouped_mesh<2>(), v.name, v.options), accepted) == "");
  CHECK(accepted == 2 * 1 + 4 * 4 + 2 * (2 * 2));  // Medit, Medit binary; Gmsh; VTK and VTU tell their variants apart
}

}  // namespace io_fuzz_test
