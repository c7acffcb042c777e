#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "projects/json.h"
#include "projects/light_spec.h"
#include "renderers/core/camera_pose.h"
#include "renderers/core/changed_shaders.h"
#include "renderers/core/material_change.h"
#include "renderers/core/method.h"
#include "renderers/core/value.h"

/// Plain data; nothing here touches files. Ids are unique within their list and made of letters, digits,
/// '-', '_' and '.', not beginning with '.', because results are named after them. Every structure keeps
/// the keys that this build does not know in `extra`, and writes them back.
namespace ir::projects {

inline constexpr int schema_version = 6;
/// Id that stands for the scene's own lights and environment wherever a set of lights is asked for.
inline constexpr const char* scene_lights = "scene";

struct MaterialOverride : MaterialChange {
    Json extra = Json::object();
    bool operator==(const MaterialOverride&) const = default;
};

/// A file or built-in scene as a part of a composed scene.
struct ScenePart {
    std::string source;        ///< path relative to the project folder, or builtin:NAME@VERSION?options
    std::string content_hash;  ///< as scene_hash() of scene_files.h gives it; empty: not yet known
    std::optional<std::array<double, 16>> transform;         ///< column-major, metres; absent: identity
    std::map<std::string, MaterialOverride> materials = {};  ///< by the name of the file's material
    std::string variant = {};  ///< of the file's materials; empty: the default ones
    Json extra = Json::object();
    bool operator==(const ScenePart&) const = default;
};

struct Scene {
    std::string id, name;
    std::vector<ScenePart> parts;  ///< at least one
    Json extra = Json::object();
    bool operator==(const Scene&) const = default;
};

/// Either a camera of the scene's file, by name, or a pose of its own.
struct Camera : CameraPose {
    std::string id, name;
    std::string scene_camera;  ///< not empty: the pose does not count
    void set_pose(const CameraPose& own) {
        scene_camera.clear();
        pose() = own;
    }
    Json extra = Json::object();
    bool operator==(const Camera&) const = default;
};

/// Radiance from infinity.
struct Environment {
    enum class Kind { scene, constant, map };
    Kind kind = Kind::scene;
    glm::dvec3 constant{0};            ///< W/(m² sr)
    std::string source, content_hash;  ///< equirectangular map, path relative to the project folder
    Json extra = Json::object();
    bool operator==(const Environment&) const = default;
};

/// A lighting: lights beside the scene's or in their place, and an environment.
struct LightSet {
    std::string id, name;
    bool use_scene_lights = false;  ///< they shine, too: "lights": ["scene", …], or "scene" for them alone
    std::vector<LightSpec> lights;
    std::vector<Json> light_extras;  ///< unknown keys of each light; shorter than or as long as `lights`
    Environment environment;
    Json extra = Json::object();
    bool operator==(const LightSet&) const = default;
};

/// The highest number of a light or a part that moves.
inline constexpr int max_moved = 1'000'000;

/// What a camera, a light or a part of a scene does over time. Linear between keys, rotations and directions
/// along the shortest arc; before the first key and after the last it stays, or begins again. Where several
/// move the same thing the last one counts.
struct Motion {
    enum class Kind { camera, light, part };
    /// Only what `kind` has of it is written.
    struct Key : CameraAim {                      // of a camera
        double time = 0;                          ///< seconds, ascending
        std::optional<glm::dvec3> position = {};  ///< of a light; what is absent is as in its set
        std::optional<glm::dvec3> look_at = {},
                                  direction = {};          ///< … at most one; written "target", "direction"
        double intensity = 1;                              ///< … factor on its strength, at least 0
        glm::dvec3 translation{0}, rotation{0}, scale{1};  ///< of a part, in place of its transform: metres;
                                                           ///< degrees about x, then y, then z
        Json extra = Json::object();
        bool operator==(const Key&) const = default;
    };
    std::string id, name;
    std::string camera;  ///< id of the camera that moves
    std::vector<Key> keys;
    Kind kind = Kind::camera;
    std::string lights = {};      ///< id of the set whose light moves, or "scene"
    int light = 0;                ///< which of the set
    std::string light_name = {};  ///< not empty: a light of the scene's file in its place
    std::string scene = {};       ///< id of the scene whose part moves
    int part = 0;                 ///< which of it
    bool loop = false;
    bool smooth = false;  ///< of a camera: through its keys without a bend
    Json extra = Json::object();
    bool operator==(const Motion&) const = default;
};

/// An image from elsewhere to compare with.
struct ForeignImage {
    std::string id, name, source, content_hash, notes;
    Json extra = Json::object();
    bool operator==(const ForeignImage&) const = default;
};

/// A named set of overrides, such as "paper" and "preview".
struct Preset {
    std::optional<glm::ivec2> size;
    std::optional<int> frames;
    Settings values;
    Json extra_values = Json::object();     ///< values that are no plain boolean, number or text
    Json extra_transport = Json::object();  ///< as Experiment::extra_transport
    Json extra = Json::object();
    bool operator==(const Preset&) const = default;
};

struct Experiment {
    std::string id, name;
    std::string scene;                  ///< id
    std::string camera;                 ///< id; empty: the scene's first camera
    std::string lights = scene_lights;  ///< id or "scene"
    std::string method;                 ///< id in the registry; unknown ones are kept, not runnable
    int method_version = 1;             ///< the version whose values these are
    /// All values by key, transport included, without the active preset's overrides; also keys that the
    /// method does not know, as read. Written as the groups "transport" and "values".
    Settings values;
    Json extra_values = Json::object();     ///< as Preset::extra_values
    Json extra_transport = Json::object();  ///< members of "transport" that are no transport keys here
    ShaderChanges shaders;                  ///< of the program, for this experiment alone
    glm::ivec2 size{512, 512};
    std::uint64_t seed = 1;
    int frames = 1;   ///< the result is the picture after exactly so many frames from empty history
    double time = 0;  ///< seconds
    std::string notes;
    std::string reference;  ///< id of the experiment that this one is judged by; may be empty
    std::map<std::string, Preset> presets;
    std::string active_preset;  ///< a key of presets, or empty
    std::string last_kept_key;  ///< in results/index.json, not in the document; empty: nothing kept
    Json extra = Json::object();
    bool operator==(const Experiment&) const = default;
};

/// Two pictures side by side. A and B are ids of experiments or foreign images.
struct Comparison {
    std::string id, name, a, b;
    std::string output;  ///< key of the output; empty: main result
    /// The views' own names: side-by-side, wipe, lens, flip, stages, difference[:KIND] with signed, absolute,
    /// relative, squared, flip, hdr-flip, significant.
    std::string mode = "wipe";
    std::optional<glm::dvec2> range;  ///< shown from … to; absent: automatic
    std::string notes;
    Json extra = Json::object();
    bool operator==(const Comparison&) const = default;
};

/// Variations of one experiment: the product of all axes, the last one fastest.
struct Sweep {
    struct Axis {
        std::string key;  ///< a parameter's key, or size, seed, frames, time, camera, lights, scene
        std::vector<Json> values;
        Json extra = Json::object();
        bool operator==(const Axis&) const = default;
    };
    std::string id, name, experiment;
    std::vector<Axis> axes;
    Json extra = Json::object();
    bool operator==(const Sweep&) const = default;
};

/// Error of experiments against one reference, over a parameter, frames, or the time that they take.
struct ErrorPlot {
    std::string id, name;
    std::string reference;                 ///< id of an experiment or a foreign image
    std::vector<std::string> experiments;  ///< ids
    std::string over = "frames";           ///< "frames", "seed", or a parameter's key
    std::vector<Json> values;  ///< that `over` takes; empty: frames 1, 2, 4, … of each experiment
    std::string metric = "rmse";
    bool against_time = true;  ///< the horizontal axis is the time of rendering; else the values
    std::string notes;
    Json extra = Json::object();
    bool operator==(const ErrorPlot&) const = default;
};

/// A question about experiments, which pictures rendered for it answer.
struct Analysis {
    std::string id, name;
    std::string kind = "disagreement";     ///< a key of analysis_kinds() (analyses.h); unknown ones are kept
    std::vector<std::string> experiments;  ///< ids; of an attribution A, then B
    std::string reference;                 ///< id of an experiment or a foreign image; may be empty
    std::vector<std::string> parameters;   ///< keys of those that take part; empty: all
    // Of kinds that take frames (analyses.h); only these have them in the file.
    std::string output;  ///< key of an image, with ".level2" or ".layer3"; empty: the main result
    int frames = 8;      ///< how many
    std::string notes;
    Json extra = Json::object();
    bool operator==(const Analysis&) const = default;
};

struct Project {
    int schema = schema_version;
    std::string name, notes;
    std::vector<Scene> scenes;
    std::vector<Camera> cameras;
    std::vector<LightSet> lights;
    std::vector<Motion> motion;
    std::vector<ForeignImage> images;
    std::vector<Experiment> experiments;
    std::vector<Comparison> comparisons;
    std::vector<Sweep> sweeps;
    std::vector<ErrorPlot> plots;
    std::vector<Analysis> analyses;
    /// Else nobody has allowed what experiments change in shaders, and none of these runs.
    bool shaders_allowed = true;
    /// Ids of experiments, also removed ones, that results/index.json names; not in the document. A new
    /// experiment gets none of them: it would come with another one's result.
    std::set<std::string> kept_ids;
    Json extra = Json::object();
    bool operator==(const Project&) const = default;
};

/// Calls visit(source, content_hash) for every file or built-in scene that a project is made of.
template <class AnyProject, class Visit>
void for_each_file(AnyProject& project, Visit visit) {
    for (auto& scene : project.scenes)
        for (auto& part : scene.parts) visit(part.source, part.content_hash);
    for (auto& set : project.lights)
        if (set.environment.kind == Environment::Kind::map)
            visit(set.environment.source, set.environment.content_hash);
    for (auto& image : project.images) visit(image.source, image.content_hash);
}

/// Item of a list by id, or null.
template <class List>
auto find_item(List& list, const std::string& id) -> decltype(list.data()) {
    for (auto& item : list)
        if (item.id == id) return &item;
    return nullptr;
}

/// Throws UsageError that names the id where there is none.
const Experiment& experiment_of(const Project& project, const std::string& id);

/// The experiment as it runs: the active preset's overrides applied, presets dropped.
Experiment effective(const Experiment& experiment);

/// Whether `id` may name an item.
bool is_valid_id(const std::string& id);
/// A valid id made of `name` ("Nave, paper view" → "nave-paper-view") that `list` does not contain yet.
std::string free_id(const std::string& name, const std::vector<std::string>& taken);
template <class List>
std::string free_id_in(const List& list, const std::string& name) {
    std::vector<std::string> taken;
    for (const auto& item : list) taken.push_back(item.id);
    return free_id(name, taken);
}
/// The same for a new experiment of the project.
std::string free_experiment_id(const Project& project, const std::string& name);

/// What to hand to the method: the experiment's effective values (active preset applied), completed with
/// defaults, without keys that the method does not know.
Settings runnable_settings(const Experiment& experiment, const MethodDescription& method);

}  // namespace ir::projects
