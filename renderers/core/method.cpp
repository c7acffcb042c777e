#include "renderers/core/method.h"

#include "renderers/core/error.h"

namespace ir {

const MethodDescription* Registry::find(const std::string& id) const {
    for (const auto* method : methods_)
        if (method->id == id) return method;
    return nullptr;
}

const MethodDescription& Registry::at(const std::string& id) const {
    if (const auto* method = find(id)) return *method;
    std::string known;
    for (const auto* method : methods_) known += (known.empty() ? "" : ", ") + method->id;
    throw UsageError("unknown method '" + id + "'; known are " + known);
}

}  // namespace ir
