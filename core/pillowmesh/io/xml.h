// As much of XML as .vtu files need: tags with attributes, one after the other.
#pragma once

#include <string>
#include <string_view>

namespace pillowmesh {

struct XmlTag {
  std::string_view name;        ///< "/Name" for a closing tag; empty at the end of the text
  std::string_view attributes;  ///< as written
  std::size_t begin = 0;        ///< of the tag in the text
  std::size_t end = 0;          ///< one past its '>'
  bool closed = false;          ///< <Name .../>
};

/// The first tag at or after `from`; comments and declarations are skipped.
XmlTag next_tag(std::string_view text, std::size_t from);

/// Value of an attribute as written, empty when it is not there.
std::string_view attribute(const XmlTag& tag, std::string_view name);

/// Text with &amp; &lt; &gt; &quot; &apos; replaced by what they mean.
std::string unescaped(std::string_view text);

}  // namespace pillowmesh
