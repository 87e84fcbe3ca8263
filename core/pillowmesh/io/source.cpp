#include "pillowmesh/io/source.h"

#include "pillowmesh/mesh/number.h"

namespace pillowmesh {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r') || c == '\0'; }

}  // namespace

std::string quoted(std::string_view piece) {
  std::string text = "'";
  for (char c : piece.substr(0, 32)) text += c >= ' ' && c <= '~' ? c : '?';
  if (piece.size() > 32) text += "...";
  return text + "'";
}

void Source::fail_at(std::int64_t place, const std::string& reason) {
  if (failed()) return;
  status_ = Status::bad_input(name_ + (binary_file_ ? ", byte " : ", line ") + std::to_string(place) + ": " + reason);
  position_ = size_;
}

void Source::fail_whole(const std::string& reason) {
  if (failed()) return;
  status_ = Status::bad_input(name_ + ": " + reason);
  position_ = size_;
}

void Source::fail_end(const char* what) {
  line_ = next_line_;
  fail(std::string("the file ends where ") + what + " should be; it is truncated");
}

void Source::fail_word(const char* what, std::string_view found) {
  fail(std::string("expected ") + what + ", found " + quoted(found));
}

std::string_view Source::word() {
  const char* c = data_ + position_;
  const char* const end = data_ + size_;
  while (c != end) {
    if (*c == '\n') {
      ++next_line_;
      ++c;
    } else if (is_space(*c)) {
      ++c;
    } else if (*c == comment_ && comment_ != '\0') {
      while (c != end && *c != '\n') ++c;
    } else {
      break;
    }
  }
  const char* const from = c;
  while (c != end && !is_space(*c)) ++c;
  position_ = static_cast<std::size_t>(c - data_);
  line_ = next_line_;
  return {from, static_cast<std::size_t>(c - from)};
}

std::string_view Source::rest_of_line() {
  const std::size_t from = position_;
  std::size_t to = find("\n");
  line_ = next_line_;
  if (to == std::string_view::npos) {
    to = size_;
    position_ = size_;
  } else {
    position_ = to + 1;
    ++next_line_;
  }
  if (to > from && data_[to - 1] == '\r') --to;
  return view(from, to - from);
}

std::int64_t Source::text_integer(const char* what) {
  const std::string_view text = word();
  std::int64_t value = 0;
  if (text.empty()) {
    fail_end(what);
  } else if (!parse_integer(text, value)) {
    fail_word(what, text);
    value = 0;
  }
  return value;
}

double Source::text_real(const char* what) {
  const std::string_view text = word();
  double value = 0.0;
  if (text.empty()) {
    fail_end(what);
  } else if (!parse_double(text, value)) {
    fail_word(what, text);
    value = 0.0;
  }
  return value;
}

std::int64_t Source::checked_count(std::int64_t count, const char* things, std::int64_t unit) {
  if (failed()) return 0;
  // A number of text takes two bytes with its separator; the last one of the file may lack that.
  const auto bytes = static_cast<std::int64_t>(remaining()) + (binary_ ? 0 : 1);
  const std::int64_t most = bytes / (binary_ ? unit : 2 * unit);
  if (count >= 0 && count <= most) return count;
  if (count < 0) {
    fail("a count of " + std::to_string(count) + " " + things + " is negative");
  } else {
    fail("the file promises " + std::to_string(count) + " " + things + " but has room for " + std::to_string(most) +
         " at the most; it is truncated or the count is wrong");
  }
  return 0;
}

void Source::seek(std::size_t position, bool counting) {
  if (failed()) return;
  if (position > size_) position = size_;
  if (counting)
    for (std::size_t i = position_; i < position; ++i) next_line_ += data_[i] == '\n' ? 1 : 0;
  position_ = position;
}

std::int64_t Source::line_of(std::size_t position) const {
  std::int64_t line = 1;
  for (std::size_t i = 0; i < position && i < size_; ++i) line += data_[i] == '\n' ? 1 : 0;
  return line;
}

}  // namespace pillowmesh
