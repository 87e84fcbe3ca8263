// Decimal numbers in text, read and written alike on every platform and in every locale.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pillowmesh {

/// Reads an unsigned decimal number (`12`, `.5`, `1.5e-3`) at the start of `text`.
/// \return the characters read, 0 if no number starts here. The value is correctly rounded for up to 15 digits and
/// moderate exponents, and otherwise within one unit in the last place; the same bits on every platform.
std::size_t read_number(std::string_view text, double& value);

/// The shortest text of 15 to 17 digits that reads back as `value`; "null" when it is not finite, as JSON wants.
std::string write_number(double value);

}  // namespace pillowmesh
