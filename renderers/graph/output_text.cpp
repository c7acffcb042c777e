#include "renderers/graph/output_text.h"

#include <stdexcept>

namespace ir::graph {

ResourceText text_of(const std::vector<OutputDescription>& outputs, const std::string& key) {
    for (const auto& output : outputs)
        if (output.key == key)
            return {output.key,      output.label, full_doc(output),
                    output.semantic, output.unit,  output.colour_map};
    throw std::logic_error("no output " + key);
}

}  // namespace ir::graph
