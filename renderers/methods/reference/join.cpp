#include "renderers/methods/reference/join.h"

#include <cstring>

#include "renderers/core/error.h"
#include "renderers/methods/reference/progress.h"
#include "renderers/methods/reference/tiles.h"

namespace ir::methods::reference {
namespace {

using Entry = graph::History::Entry;

bool are_alike(const Entry& a, const Entry& b) {
    return a.key == b.key && a.is_image == b.is_image && a.shape == b.shape &&
           a.element_bytes == b.element_bytes && a.elements == b.elements && a.bytes.size() == b.bytes.size();
}

void join_pixels(Entry& whole, const Entry& part, const Shard& shard) {
    const auto pixels =
        static_cast<std::size_t>(whole.shape.width) * static_cast<std::size_t>(whole.shape.height);
    const auto layers = static_cast<std::size_t>(std::max(1, whole.shape.layers));
    const auto bytes = whole.bytes.size() / (pixels * layers);
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        if (!Tiles::has_pixel(shard, whole.shape.width, pixel)) continue;
        for (std::size_t layer = 0; layer < layers; ++layer) {
            const auto at = (layer * pixels + pixel) * bytes;
            std::memcpy(&whole.bytes[at], &part.bytes[at], bytes);
        }
    }
}

}  // namespace

void join(graph::History& whole, const graph::History& part, const Shard& shard) {
    bool fits = whole.entries.size() == part.entries.size();
    for (std::size_t i = 0; fits && i < whole.entries.size(); ++i)
        fits = are_alike(whole.entries[i], part.entries[i]);
    if (!fits) throw Error("parts of a picture have other buffers than each other");
    for (std::size_t i = 0; i < whole.entries.size(); ++i) {
        auto& entry = whole.entries[i];
        if (entry.is_image)
            join_pixels(entry, part.entries[i], shard);
        else
            Progress::join(entry.bytes, part.entries[i].bytes);
    }
}

}  // namespace ir::methods::reference
