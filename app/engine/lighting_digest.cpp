#include "app/engine/lighting_digest.h"

#include <sstream>

#include "renderers/core/hash.h"

namespace ir::engine {

std::string lighting_digest(const std::vector<scene::Light>& lights, const scene::Environment& environment) {
    std::ostringstream text;
    text << std::hexfloat;
    const auto add = [&](auto... numbers) { ((text << ' ' << numbers), ...); };
    add(environment.constant.x, environment.constant.y, environment.constant.z);
    if (const auto& map = environment.map; map && !map->empty()) {
        text << ' ' << map->width << 'x' << map->height << ' ' << environment.hash_of_map();
    }
    for (const auto& light : lights) {
        text << ';' << static_cast<int>(light.type);
        for (const float number : light.numbers()) add(number);
    }
    return hash_bytes(text.str());
}

}  // namespace ir::engine
