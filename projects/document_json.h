#pragma once

#include <string>
#include <vector>

#include "projects/document.h"
#include "projects/json.h"
#include "renderers/core/method.h"
#include "renderers/core/report.h"

namespace ir::projects {

struct ReadProject {
    Project project;
    int schema_in_file = schema_version;
    std::vector<Message> messages;  ///< migrations done, values filled in; see also check()
};

/// Text of `file` (a name for messages) to a document of the newest schema: migrates, checks every value
/// against the method's description, completes values that newer versions of a method introduced. Throws
/// InputError that names file, place (JSON pointer) and mend; the file is never touched.
ReadProject read_project(const std::string& text, const std::string& file, const Registry& registry);

/// The document as pretty text, stable to the byte.
std::string write_project(const Project& project);

Json to_json(const Project& project);
Json to_json(const LightSpec& light);
/// Only members that it changes and this build knows.
Json to_json(const MaterialOverride& change);
/// What decides what a camera sees, by the keys of its fields: orthographic ones have a height, others
/// fov_y_degrees.
Json pose_json(const CameraPose& pose);
/// What of it moves, without the ids of what is moved: its keys, and whether it begins again.
Json motion_inputs(const Motion& motion);
/// The values of a key alone.
Json key_inputs(const Motion::Key& key, Motion::Kind kind);

/// JSON pointers of all kept keys that this build does not know, values of known methods included.
std::vector<std::string> unknown_keys(const Project& project, const Registry& registry);
/// A warning for each.
std::vector<Message> unknown_key_messages(const Project& project, const Registry& registry);

}  // namespace ir::projects
