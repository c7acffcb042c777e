#include "projects/motion.h"

#include <algorithm>
#include <cmath>

namespace ir::projects {
namespace {

using Key = Motion::Key;

glm::dvec3 mixed(const glm::dvec3& a, const glm::dvec3& b, double t) {
    return a + t * (b - a);
}

std::optional<glm::dvec3> mixed(const std::optional<glm::dvec3>& a, const std::optional<glm::dvec3>& b,
                                double t) {
    if (!a || !b) return a;
    return mixed(*a, *b, t);
}

/// Along the great circle; between opposite directions, which have no shortest arc, it jumps halfway.
glm::dvec3 turned(const glm::dvec3& a, const glm::dvec3& b, double t) {
    const auto from = glm::normalize(a), to = glm::normalize(b);
    const double angle = std::acos(std::clamp(glm::dot(from, to), -1.0, 1.0)), sine = std::sin(angle);
    if (sine < 1e-9) return t < 0.5 ? from : to;
    return (std::sin((1 - t) * angle) * from + std::sin(t * angle) * to) / sine;
}

/// Angles of a rotation, as rotation_of() takes them.
glm::dvec3 degrees_of(const glm::dquat& q) {
    return glm::degrees(glm::eulerAngles(q));
}

Key between(const Key& a, const Key& b, double t) {
    Key key;
    key.eye = mixed(a.eye, b.eye, t);
    key.target = mixed(a.target, b.target, t);
    key.up = mixed(a.up, b.up, t);
    key.position = mixed(a.position, b.position, t);
    key.look_at = mixed(a.look_at, b.look_at, t);
    key.direction = a.direction && b.direction ? turned(*a.direction, *b.direction, t) : a.direction;
    key.intensity = a.intensity + t * (b.intensity - a.intensity);
    key.translation = mixed(a.translation, b.translation, t);
    key.scale = mixed(a.scale, b.scale, t);
    if (a.rotation == b.rotation)
        key.rotation = a.rotation;
    else
        key.rotation = degrees_of(glm::slerp(rotation_of(a.rotation), rotation_of(b.rotation), t));
    return key;
}

using Aim = glm::dvec3 CameraAim::*;

const CameraAim& aim_of(const Key& key) {
    return key;
}

/// At most three times the slower of the speeds before and after a key: what moves along a line then never
/// turns back between two keys, whatever their times [Fritsch80].
glm::dvec3 bounded(const glm::dvec3& slope, const glm::dvec3& before, const glm::dvec3& after) {
    const double most = 3 * std::min(glm::length(before), glm::length(after)), speed = glm::length(slope);
    return speed > most ? slope * (most / speed) : slope;
}

/// The change per second at a key: of the parabola through it and its neighbours, bounded. The ends of a path
/// have that of the parabola through the last three, or of the line through the last two. A loop whose ends
/// are equal goes on through them.
glm::dvec3 slope(const Motion& motion, std::size_t index, Aim part) {
    const auto& keys = motion.keys;
    const std::size_t last = keys.size() - 1;
    const auto between = [&](std::size_t i) {
        return (keys[i + 1].*part - keys[i].*part) / (keys[i + 1].time - keys[i].time);
    };
    const auto length = [&](std::size_t i) { return keys[i + 1].time - keys[i].time; };
    const auto mean = [&](std::size_t before, std::size_t after) {
        const double a = length(before), b = length(after);
        return bounded((b * between(before) + a * between(after)) / (a + b), between(before), between(after));
    };
    if (index > 0 && index < last) return mean(index - 1, index);
    if (motion.loop && aim_of(keys.front()) == aim_of(keys.back())) return mean(last - 1, 0);
    if (last == 1) return between(0);
    const std::size_t end = index == 0 ? 0 : last - 1, next = index == 0 ? 0 : last - 2;
    const auto last_slope = 2.0 * between(end) - mean(next, next + 1);
    const bool turns_back = glm::dot(last_slope, between(end)) < 0;
    return turns_back ? glm::dvec3(0) : bounded(last_slope, between(end), between(end));
}

/// Cubic, with those values and slopes at both keys (Hermite); s from 0 to 1.
glm::dvec3 curved(const Motion& motion, std::size_t index, double s, Aim part) {
    const auto& a = motion.keys[index];
    const auto& b = motion.keys[index + 1];
    const double length = b.time - a.time, r = 1 - s;
    return (1 + 2 * s) * r * r * (a.*part) + s * s * (3 - 2 * s) * (b.*part) +
           length * s * r * (r * slope(motion, index, part) - s * slope(motion, index + 1, part));
}

/// Taken back into the keys' own time, where it begins again after the last.
double within(const Motion& motion, double time) {
    const double first = motion.keys.front().time, length = motion.keys.back().time - first;
    if (!motion.loop || !(length > 0)) return time;
    return time - length * std::floor((time - first) / length);
}

template <class Moves>
const Motion* last_of(const Project& project, Moves moves) {
    const auto found = std::find_if(project.motion.rbegin(), project.motion.rend(),
                                    [&](const Motion& m) { return !m.keys.empty() && moves(m); });
    return found == project.motion.rend() ? nullptr : &*found;
}

}  // namespace

std::string to_string(Motion::Kind kind) {
    return kind == Motion::Kind::camera ? "camera" : kind == Motion::Kind::light ? "light" : "part";
}

Key key_at(const Motion& motion, double time) {
    const auto& keys = motion.keys;
    const double own_time = within(motion, time);
    const auto after = std::upper_bound(keys.begin(), keys.end(), own_time,
                                        [](double t, const Key& key) { return t < key.time; });
    if (after == keys.begin()) return keys.front();
    if (after == keys.end()) return keys.back();
    const auto& before = *std::prev(after);
    const double share = (own_time - before.time) / (after->time - before.time);
    auto key = between(before, *after, share);
    if (motion.smooth)
        for (const Aim part : {&Key::eye, &Key::target, &Key::up})
            key.*part = curved(motion, std::size_t(after - keys.begin()) - 1, share, part);
    key.time = own_time;
    return key;
}

bool is_moving(const Motion& motion) {
    const auto same = [&](Key key) {
        key.time = motion.keys.front().time;
        key.extra = motion.keys.front().extra;
        return key == motion.keys.front();
    };
    return !std::all_of(motion.keys.begin(), motion.keys.end(), same);
}

const Motion* motion_of_camera(const Project& project, const std::string& camera) {
    return last_of(project,
                   [&](const Motion& m) { return m.kind == Motion::Kind::camera && m.camera == camera; });
}

const Motion* motion_of_light(const Project& project, const std::string& lights, int light) {
    return last_of(project, [&](const Motion& m) {
        return m.kind == Motion::Kind::light && m.lights == lights && m.light_name.empty() &&
               m.light == light;
    });
}

const Motion* motion_of_light(const Project& project, const std::string& lights, const std::string& name) {
    return last_of(project, [&](const Motion& m) {
        return m.kind == Motion::Kind::light && m.lights == lights && !name.empty() && m.light_name == name;
    });
}

const Motion* motion_of_part(const Project& project, const std::string& scene, int part) {
    return last_of(project, [&](const Motion& m) {
        return m.kind == Motion::Kind::part && m.scene == scene && m.part == part;
    });
}

std::vector<const Motion*> motions_of(const Project& project, const Experiment& experiment) {
    const auto* camera = find_item(project.cameras, experiment.camera);
    std::vector<const Motion*> found;
    for (const auto& motion : project.motion) {
        const Motion* counts = nullptr;
        if (motion.kind == Motion::Kind::camera && motion.camera == experiment.camera && camera &&
            camera->scene_camera.empty())
            counts = motion_of_camera(project, motion.camera);
        if (motion.kind == Motion::Kind::light && motion.lights == experiment.lights)
            counts = motion.light_name.empty() ? motion_of_light(project, motion.lights, motion.light)
                                               : motion_of_light(project, motion.lights, motion.light_name);
        if (motion.kind == Motion::Kind::part && motion.scene == experiment.scene)
            counts = motion_of_part(project, motion.scene, motion.part);
        if (counts == &motion) found.push_back(counts);
    }
    return found;
}

double moves_until(const Project& project, const Experiment& experiment) {
    double end = 0;
    for (const auto* motion : motions_of(project, experiment))
        if (is_moving(*motion)) end = std::max(end, motion->keys.back().time);
    return end;
}

Camera camera_at(const Project& project, const Camera& camera, double time) {
    Camera result = camera;
    const auto* motion = camera.scene_camera.empty() ? motion_of_camera(project, camera.id) : nullptr;
    if (!motion) return result;
    result.aim() = key_at(*motion, time);
    return result;
}

LightSpec light_at(const LightSpec& light, const Key& key) {
    using Type = LightSpec::Type;
    LightSpec result = light;
    result.amount *= key.intensity;
    if (key.position && light.type != Type::directional) result.position = *key.position;
    if (light.type == Type::point || !(key.look_at || key.direction)) return result;
    const bool looks = key.look_at && light.type != Type::directional;
    if (!looks && !key.direction) return result;
    result.target = looks ? key.look_at : std::nullopt;
    result.direction = looks ? std::nullopt : key.direction;
    return result;
}

glm::dquat rotation_of(const glm::dvec3& degrees) {
    return glm::dquat(glm::radians(degrees));
}

std::array<double, 16> transform_of(const Key& key) {
    auto matrix = glm::mat4_cast(rotation_of(key.rotation));
    for (int i = 0; i < 3; ++i) matrix[i] *= key.scale[i];
    matrix[3] = glm::dvec4(key.translation, 1);
    std::array<double, 16> numbers;
    for (int i = 0; i < 16; ++i) numbers[std::size_t(i)] = matrix[i / 4][i % 4];
    return numbers;
}

Key key_of(const std::array<double, 16>& transform) {
    glm::dmat3 axes;
    Key key;
    for (int i = 0; i < 3; ++i) {
        for (int row = 0; row < 3; ++row) axes[i][row] = transform[std::size_t(4 * i + row)];
        key.translation[i] = transform[std::size_t(12 + i)];
        key.scale[i] = glm::length(axes[i]);
        if (key.scale[i] > 0) axes[i] /= key.scale[i];
    }
    if (glm::determinant(axes) < 0) {
        key.scale.x = -key.scale.x;
        axes[0] = -axes[0];
    }
    key.rotation = degrees_of(glm::quat_cast(axes));
    return key;
}

}  // namespace ir::projects
