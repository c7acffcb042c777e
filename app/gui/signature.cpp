#include "app/gui/signature.h"

#include <sstream>

#include "app/engine/lighting_digest.h"
#include "app/engine/moving.h"

namespace ir::gui {
namespace {

std::ostream& operator<<(std::ostream& out, const glm::vec3& v) {
    return out << v.x << ',' << v.y << ',' << v.z << ';';
}

void write_camera(std::ostream& out, const scene::Camera& c) {
    out << c.eye << c.target << c.up << c.fov_y << ',' << c.orthographic << ',' << c.height << '\n';
}

}  // namespace

std::string signature(const engine::Experiment& e) {
    std::ostringstream out;
    out.precision(17);
    out << scene::composition_key(e.composition()) << '\n' << e.method << '\n';
    for (const auto& [key, value] : e.settings) out << key << '=' << to_string(value) << '\n';
    out << e.camera_name << '\n';
    if (e.camera) write_camera(out, *e.camera);
    if (e.replace_lights) out << "lights\n";
    if (e.environment) out << "environment\n";
    out << engine::lighting_digest(e.lights, e.environment.value_or(scene::Environment{})) << '\n';
    out << e.width << 'x' << e.height << ' ' << e.seed << ' ' << e.frames << ' ' << e.time;
    out << '\n' << engine::motion_text(e);
    return out.str();
}

}  // namespace ir::gui
