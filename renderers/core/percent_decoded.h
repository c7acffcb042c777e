#pragma once

#include <string>

namespace ir {

/// A URI's text without its codes of a percent sign and two hexadecimal digits; what is none stays. [RFC 3986
/// §2.1]
std::string percent_decoded(const std::string& uri);

}  // namespace ir
