#include "app/engine/lighting_digest.h"

#include <sstream>
#include <string_view>

#include "projects/hash.h"

namespace ir::engine {

std::string lighting_digest(const std::vector<scene::Light>& lights, const scene::Environment& environment) {
    std::ostringstream text;
    text << std::hexfloat;
    const auto add = [&](auto... numbers) { ((text << ' ' << numbers), ...); };
    add(environment.constant.x, environment.constant.y, environment.constant.z);
    if (const auto& map = environment.map; map && !map->empty()) {
        const std::string_view bytes(reinterpret_cast<const char*>(map->pixels.data()),
                                     map->pixels.size() * sizeof(float));
        text << ' ' << map->width << 'x' << map->height << ' ' << projects::hash_bytes(bytes);
    }
    for (const auto& light : lights) {
        text << ';' << static_cast<int>(light.type);
        for (const auto& v : {light.position, light.direction, light.colour}) add(v.x, v.y, v.z);
        add(light.intensity, light.range, light.inner_angle, light.outer_angle, light.size.x, light.size.y);
    }
    return projects::hash_bytes(text.str());
}

}  // namespace ir::engine
