#include "pillowmesh/io/xml.h"

namespace pillowmesh {
namespace {
bool is_white(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
}  // namespace

XmlTag next_tag(std::string_view text, std::size_t from) {
  XmlTag tag;
  for (;;) {
    const std::size_t open = text.find('<', from);
    if (open == std::string_view::npos) return {};
    const std::string_view rest = text.substr(open);
    if (rest.starts_with("<!--")) {
      from = text.find("-->", open);
      if (from == std::string_view::npos) return {};
      continue;
    }
    // A '>' inside of a quoted value does not end the tag.
    std::size_t close = open + 1;
    for (char quote = '\0'; close < text.size() && (quote != '\0' || text[close] != '>'); ++close) {
      const char c = text[close];
      if (quote != '\0') {
        if (c == quote) quote = '\0';
      } else if (c == '"' || c == '\'') {
        quote = c;
      }
    }
    if (close >= text.size()) return {};
    from = close + 1;
    if (rest.starts_with("<?") || rest.starts_with("<!")) continue;
    std::string_view inside = text.substr(open + 1, close - open - 1);
    tag.begin = open;
    tag.end = close + 1;
    if (!inside.empty() && inside.back() == '/') {
      tag.closed = true;
      inside.remove_suffix(1);
    }
    std::size_t n = 0;
    while (n < inside.size() && !is_white(inside[n])) ++n;
    tag.name = inside.substr(0, n);
    tag.attributes = inside.substr(n);
    return tag;
  }
}

std::string_view attribute(const XmlTag& tag, std::string_view name) {
  const std::string_view text = tag.attributes;
  std::size_t i = 0;
  while (i < text.size()) {
    while (i < text.size() && is_white(text[i])) ++i;
    const std::size_t key = i;
    while (i < text.size() && text[i] != '=' && !is_white(text[i])) ++i;
    const std::string_view found = text.substr(key, i - key);
    while (i < text.size() && (is_white(text[i]) || text[i] == '=')) ++i;
    if (i >= text.size() || (text[i] != '"' && text[i] != '\'')) return {};
    const char quote = text[i++];
    const std::size_t end = text.find(quote, i);
    if (end == std::string_view::npos) return {};
    if (found == name) return text.substr(i, end - i);
    i = end + 1;
  }
  return {};
}

std::string unescaped(std::string_view text) {
  struct Entity {
    std::string_view name;
    char character;
  };
  constexpr Entity entities[] = {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
  std::string out;
  while (!text.empty()) {
    std::size_t taken = 1;
    char c = text[0];
    for (const Entity& e : entities)
      if (text.starts_with(e.name)) {
        taken = e.name.size();
        c = e.character;
      }
    out += c;
    text.remove_prefix(taken);
  }
  return out;
}

}  // namespace pillowmesh
