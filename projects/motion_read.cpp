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

void read_light(ObjectReader& reader, Motion& motion) {
    if (const auto* light = reader.take("light"); light && light->is_string())
        motion.light_name = light->get<std::string>();
    else
        motion.light = static_cast<int>(reader.integer("light", 0, 0, max_moved));
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
    read_fields(reader, motion, motion_fields(motion.kind));
    if (motion.kind == Motion::Kind::light) read_light(reader, motion);
    motion.loop = reader.flag("loop", false);
    if (motion.kind == Motion::Kind::camera) motion.smooth = reader.flag("smooth", false);
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
