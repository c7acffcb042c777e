#pragma once

#include <string>
#include <vector>

#include "renderers/core/parameter.h"

namespace ir {

/// What one method takes over from another.
struct CarriedTransport {
    Settings values;
    std::vector<std::string> lost;  ///< one line for each value that could not be taken over
};

/// The transport that a method with parameters `to` computes in place of one with parameters `from` (none
/// where it is unknown), of the keys in `values` that it has. A value at the default of `from` becomes the
/// default of `to`; any other is kept, or becomes that default where `to` does not allow it.
CarriedTransport carry_transport(const Settings& values, const std::vector<ParameterDescription>& from,
                                 const std::vector<ParameterDescription>& to);

}  // namespace ir
