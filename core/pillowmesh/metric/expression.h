// Metric formulas: from text to a graph of operations.
//
//     formula    = statement { ";" statement } [ ";" ]
//     statement  = name "=" expression
//     expression = sum [ ("<" | "<=" | ">" | ">=" | "==" | "!=") sum ]         1 if true, 0 if not
//     sum        = term { ("+" | "-") term }
//     term       = factor { ("*" | "/") factor }
//     factor     = ("-" | "+") factor | primary [ "^" factor ]                 -x^2 = -(x^2), 2^3^2 = 2^9
//     primary    = number | name | name "(" expression { "," expression } ")" | "(" expression ")"
//
// Names: x, y, z (3D only), r = |(x, y, z)|, pi, and what earlier statements have assigned. Functions: if(c, a, b),
// sqrt exp log sin cos tan atan atan2 asin acos tanh abs min max pow floor; min and max take two or more arguments.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pillowmesh/mesh/status.h"
#include "pillowmesh/metric/graph.h"

namespace pillowmesh {

/// What a formula assigns.
struct Formula {
  struct Assignment {
    std::string name;
    NodeId value;
    int column;  ///< of the name, counted from 1
  };
  Graph graph;
  std::vector<Assignment> assignments;  ///< in the order of the text; the last one to a name counts

  /// The last assignment to `name`, or nullptr.
  [[nodiscard]] const Assignment* find(std::string_view name) const;
};

/// Parses a formula over `dim` coordinates (2 or 3).
/// \return usage: "column 12: unknown name 'foo'; known: x, y, r, pi, ...". Columns count characters from 1; a line
/// break counts as one. Cost: linear up to a logarithm.
Expected<Formula> parse_formula(std::string_view text, int dim);

}  // namespace pillowmesh
