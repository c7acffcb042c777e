#include "widgets/document/pose_text.h"

#include <sstream>
#include <vector>

#include "projects/light_spec.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/value.h"

namespace ir::widgets {
namespace {

std::string joined(const glm::dvec3& v) {
    return shortest_text(v.x) + "," + shortest_text(v.y) + "," + shortest_text(v.z);
}

/// Words of the text; "x, y, z" counts as one, options of the command line do not count.
std::vector<std::string> words_of(std::string_view text) {
    std::string joined_text;
    for (const char c : text) {
        const bool after_comma = !joined_text.empty() && joined_text.back() == ',';
        const bool is_space = c == ' ' || c == '\t' || c == '\n' || c == ';';
        if (is_space && after_comma) continue;
        if (c == ',')
            while (!joined_text.empty() && joined_text.back() == ' ') joined_text.pop_back();
        joined_text += is_space ? ' ' : c;
    }
    std::istringstream stream(joined_text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;)
        if (word.rfind("--", 0) != 0) words.push_back(word);
    return words;
}

}  // namespace

std::string pose_text(const CameraPose& pose) {
    return joined(pose.eye) + " " + joined(pose.target) + " " + joined(pose.up) + " " +
           (pose.orthographic ? shortest_text(pose.height) + "m" : shortest_text(pose.fov_y_degrees));
}

CameraPose parse_pose(std::string_view text, const CameraPose& present) {
    const auto words = words_of(text);
    if (words.size() < 2 || words.size() > 4)
        throw UsageError("pose: '" + projects::printable(text, 60) +
                         "' is not allowed; give eye, target, up and field of view as x,y,z x,y,z x,y,z FOV");
    CameraPose pose = present;
    pose.eye = projects::parse_vec3(words[0], "pose, eye");
    pose.target = projects::parse_vec3(words[1], "pose, target");
    if (words.size() > 2) pose.up = projects::parse_vec3(words[2], "pose, up");
    if (words.size() < 4) return pose;
    std::string_view last = words[3];
    pose.orthographic = last.back() == 'm';
    if (pose.orthographic) last.remove_suffix(1);
    (pose.orthographic ? pose.height : pose.fov_y_degrees) =
        projects::parse_number(last, pose.orthographic ? "pose, height" : "pose, field of view");
    return pose;
}

}  // namespace ir::widgets
