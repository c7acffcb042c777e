#include "projects/value_reader.h"

#include "projects/document_fields.h"
#include "projects/motion.h"
#include "projects/text.h"
#include "projects/validate.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

Motion::Kind read_kind(ObjectReader& reader) {
    const auto name = reader.text("moves", to_string(Motion::Kind::camera));
    for (const auto kind : {Motion::Kind::camera, Motion::Kind::light, Motion::Kind::part})
        if (to_string(kind) == name) return kind;
    reader.fail("moves", "'" + printable(name, 60) + "' cannot move; give camera, light or part");
}

void read_target(ObjectReader& reader, Motion& motion) {
    constexpr int most = 1'000'000;
    switch (motion.kind) {
        case Motion::Kind::camera:
            motion.camera = reader.text("camera");
            return;
        case Motion::Kind::light:
            motion.lights = reader.text("lights");
            if (const auto* light = reader.take("light"); light && light->is_string())
                motion.light_name = light->get<std::string>();
            else
                motion.light = static_cast<int>(reader.integer("light", 0, 0, most));
            return;
        case Motion::Kind::part:
            motion.scene = reader.text("scene");
            motion.part = static_cast<int>(reader.integer("part", 0, 0, most));
    }
}

Motion::Key read_key(ObjectReader& reader, Motion::Kind kind) {
    Motion::Key key;
    read_fields(reader, key, key_fields(kind));
    key.extra = reader.rest();
    return key;
}

}  // namespace

void read_motion(ObjectReader& reader, Motion& motion) {
    motion.kind = read_kind(reader);
    read_target(reader, motion);
    motion.loop = reader.flag("loop", false);
    reader.each("keys", [&](const Json& json, const std::string& pointer) {
        ObjectReader inner(json, reader.file(), pointer);
        auto key = read_key(inner, motion.kind);
        if (!motion.keys.empty() && !(key.time > motion.keys.back().time))
            inner.fail("time", "must be later than that of the key before");
        motion.keys.push_back(std::move(key));
    });
    try {
        validate(motion);
    } catch (const UsageError& error) {
        throw InputError(reader.file(), reader.pointer(), error.what());
    }
}

}  // namespace ir::projects
