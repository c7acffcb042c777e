#include "renderers/core/carry_transport.h"

#include "renderers/core/error.h"
#include "renderers/core/transport.h"

namespace ir {

CarriedTransport carry_transport(const Settings& values, const std::vector<ParameterDescription>& from,
                                 const std::vector<ParameterDescription>& to) {
    CarriedTransport carried;
    for (const auto& [key, value] : values) {
        const auto *before = find(from, key), *after = find(to, key);
        if (!is_transport_key(key)) continue;
        const bool is_default = before && value == before->default_value;
        if (!after) {
            if (before && !is_default && is_active(*before, values))
                carried.lost.push_back("parameter '" + key + "': '" + to_string(value) +
                                       "' is lost, as the method has no such parameter");
            continue;
        }
        carried.values[key] = after->default_value;
        if (is_default) continue;
        try {
            carried.values[key] = after->checked(value);
        } catch (const UsageError& error) {
            carried.lost.push_back(std::string(error.what()) + "; its default '" +
                                   to_string(after->default_value) + "' is taken");
        }
    }
    return carried;
}

}  // namespace ir
