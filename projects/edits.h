#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "projects/document.h"
#include "renderers/core/method.h"

namespace ir::projects {

/// One change of the document. Built against a document's present state, applied and reverted any number of
/// times in the stack's order. Every change that a user can make is one of these.
class Edit {
  public:
    explicit Edit(std::string label, std::string merge_key = {})
        : label_(std::move(label)), merge_key_(std::move(merge_key)) {}
    virtual ~Edit() = default;
    virtual void apply(Project& project) = 0;
    virtual void revert(Project& project) = 0;
    /// Takes over the outcome of `later`, which has the same merge key; false when that is impossible.
    virtual bool absorb(const Edit& /*later*/) { return false; }
    virtual bool changes_nothing() const { return false; }
    const std::string& label() const { return label_; }          ///< "Change Maximum distance"
    const std::string& merge_key() const { return merge_key_; }  ///< empty: never merges

  private:
    std::string label_, merge_key_;
};

using EditPtr = std::unique_ptr<Edit>;

/// Makers of edits. They check ids, values and ranges and throw UsageError with one line, in which case
/// nothing has changed.
namespace edits {

/// Values by key, transport included; checked against the method. A key that the active preset overrides is
/// changed in the preset, every other in the experiment itself, so that what the user sees changes.
EditPtr set_values(const Project& project, const Registry& registry, const std::string& experiment,
                   const Settings& values);
/// Back to the method's default.
EditPtr reset_value(const Project& project, const Registry& registry, const std::string& experiment,
                    const std::string& key);
/// Another method: its defaults and shaders, but for the transport that carry_transport() takes over, also of
/// presets. A name that the program gave follows, and names that were made of it.
EditPtr set_method(const Project& project, const Registry& registry, const std::string& experiment,
                   const std::string& method);
/// The transport that set_method() cannot take over of what the experiment computes now, and its changed
/// shaders, one line each.
std::vector<std::string> lost_by_method(const Project& project, const Registry& registry,
                                        const std::string& experiment, const std::string& method);

EditPtr set_scene_of(const Project& project, const std::string& experiment, const std::string& scene);
EditPtr set_camera_of(const Project& project, const std::string& experiment, const std::string& camera);
EditPtr set_lights_of(const Project& project, const std::string& experiment, const std::string& lights);
/// Size, frames: like values, they change the active preset where that overrides them.
EditPtr set_size(const Project& project, const std::string& experiment, glm::ivec2 size);
EditPtr set_seed(const Project& project, const std::string& experiment, std::uint64_t seed);
EditPtr set_frames(const Project& project, const std::string& experiment, int frames);
EditPtr set_time(const Project& project, const std::string& experiment, double seconds);
/// Hunks that change a shader file for the experiment; empty: none.
EditPtr set_shader(const Project& project, const std::string& experiment, const std::string& file,
                   const std::string& hunks);
EditPtr set_experiment_notes(const Project& project, const std::string& experiment, const std::string& notes);
EditPtr set_reference(const Project& project, const std::string& experiment, const std::string& reference);
EditPtr set_active_preset(const Project& project, const std::string& experiment, const std::string& preset);

/// Other files for sources (scenes, maps, images) by the old ones, all in one step. Recorded hashes stay.
EditPtr relocate(const Project& project, const std::map<std::string, std::string>& new_sources);

/// Adding: at `position`, or at the end where it is absent. The item's id must be free (see free_id_in).
template <class Item>
EditPtr add(const Project& project, const Item& item, std::optional<std::size_t> position = {});
/// Removing refuses while others refer to the item, and names them.
template <class Item>
EditPtr remove(const Project& project, const std::string& id);
/// A copy behind the original with a free id and " copy" in its name; experiments lose their kept result.
template <class Item>
EditPtr duplicate(const Project& project, const std::string& id);
/// The name that people see; names that the program made of an experiment's follow.
template <class Item>
EditPtr rename(const Project& project, const std::string& id, const std::string& name);
/// The item replaces the one with its id; same-id calls merge (camera orbits, light drags). Also how Locate…
/// and "accept the changed file" work: see scene_files.h.
template <class Item>
EditPtr change(const Project& project, const Item& item);
/// Moves the item to `position` in its list.
template <class Item>
EditPtr move(const Project& project, const std::string& id, std::size_t position);
/// These templates exist for Scene, Camera, LightSet, Motion, ForeignImage, Experiment, Comparison, Sweep,
/// ErrorPlot, Analysis.

/// A new experiment with all defaults, ready for add(). Without a name it is called after its method, and
/// follows it.
Experiment new_experiment(const Project& project, const Registry& registry, const std::string& method,
                          const std::string& name, const std::string& scene, const std::string& camera);

EditPtr set_project_name(const Project& project, const std::string& name);
EditPtr set_notes(const Project& project, const std::string& notes);
/// Whether what experiments change in shaders may run.
EditPtr set_shaders_allowed(const Project& project, bool allowed);

/// Several edits as one step; each was made against the state that the ones before it leave.
EditPtr group(std::string label, std::vector<EditPtr> edits);

}  // namespace edits
}  // namespace ir::projects
