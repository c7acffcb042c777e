#include "renderers/core/processor.h"

#include "renderers/core/error.h"

namespace ir {

std::string to_string(Processor processor) {
    return processor == Processor::gl ? "gl" : "host";
}

std::optional<Processor> parse_processor(const std::string& text) {
    for (const auto processor : {Processor::gl, Processor::host})
        if (text == to_string(processor)) return processor;
    if (text.empty() || text == "auto") return {};
    throw UsageError("unknown processor '" + text + "'; there are auto, gl and host");
}

}  // namespace ir
