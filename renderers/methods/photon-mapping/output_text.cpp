#include "renderers/methods/photon-mapping/output_text.h"

#include <stdexcept>

namespace ir::methods::photon_mapping {

graph::ResourceText text_of(const std::vector<OutputDescription>& outputs, const std::string& key) {
    for (const auto& output : outputs)
        if (output.key == key)
            return {output.key, output.label, output.doc, output.semantic, output.unit, output.colour_map};
    throw std::logic_error("no output " + key);
}

}  // namespace ir::methods::photon_mapping
