#include "projects/check.h"

#include <algorithm>

#include "projects/motion.h"
#include "projects/results.h"
#include "projects/scene_files.h"
#include "projects/text.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

class Checker {
  public:
    Checker(const ReadProject& read, const fs::path& folder, const Registry& registry,
            const ContentHashes* known)
        : read_(read), project_(read.project), folder_(folder), registry_(registry), known_(known) {}

    std::vector<Message> run() {
        files();
        for (const auto& experiment : project_.experiments) check(experiment);
        references();
        for (const auto& key : unknown_keys(project_, registry_))
            say(Severity::warning, "unknown key " + printable(key) + " is kept and ignored");
        if (read_.schema_in_file < schema_version)
            say(Severity::note, "has schema " + std::to_string(read_.schema_in_file) + ", the newest is " +
                                    std::to_string(schema_version) + "; saving or --upgrade rewrites it");
        messages_.insert(messages_.end(), read_.messages.begin(), read_.messages.end());
        std::stable_sort(messages_.begin(), messages_.end(),
                         [](const Message& a, const Message& b) { return a.severity > b.severity; });
        return std::move(messages_);
    }

  private:
    void say(Severity severity, const std::string& text) { messages_.push_back({severity, "project", text}); }

    void report(const std::string& what, const FileStatus& status, const std::string& mend) {
        const std::string source = "'" + printable(status.source) + "'";
        if (status.state == FileState::missing)
            say(Severity::error, what + ": " + source + " is missing; locate it" + mend);
        if (status.state == FileState::changed)
            say(Severity::warning,
                what + ": " + source +
                    " is not the file that was recorded; accept it or restore the old one");
        if (!is_builtin(status.source) && fs::path(status.source).is_absolute())
            say(Severity::note,
                what + ": " + source + " is an absolute path; other machines will have to locate it");
    }

    void files() {
        for (const auto& scene : project_.scenes)
            for (const auto& part : scene.parts)
                report("scene '" + scene.id + "'", status(part, folder_, known_), " or restore it");
        for (const auto& set : project_.lights)
            if (set.environment.kind == Environment::Kind::map)
                report("environment of '" + set.id + "'", status(set.environment, folder_, known_), "");
        for (const auto& image : project_.images)
            report("image '" + image.id + "'", status(image, folder_, known_), "");
    }

    void check(const Experiment& experiment) {
        const std::string where = "experiment '" + experiment.id + "': ";
        const auto* method = registry_.find(experiment.method);
        if (!method) {
            say(Severity::warning, where + "method '" + printable(experiment.method, 60) +
                                       "' is unknown to this build; it is kept and cannot run");
        } else if (method->version < experiment.method_version) {
            say(Severity::warning, where + "was made with version " +
                                       std::to_string(experiment.method_version) + " of " + method->id +
                                       ", this build has " + std::to_string(method->version) +
                                       "; pictures may differ");
        } else if (method->version > experiment.method_version) {
            say(Severity::note, where + "was made with version " + std::to_string(experiment.method_version) +
                                    " of " + method->id + ", this build has " +
                                    std::to_string(method->version));
        }
        if (is_stale(project_, experiment, registry_, known_ ? *known_ : ContentHashes{}))
            say(Severity::note, where + "its kept result is stale; render it again");
    }

    void check(const Motion& motion) {
        const std::string who = "motion '" + motion.id + "'";
        const Motion* counts = nullptr;
        switch (motion.kind) {
            case Motion::Kind::camera:
                refer(who, "camera", project_.cameras, motion.camera);
                counts = motion_of_camera(project_, motion.camera);
                break;
            case Motion::Kind::light: {
                refer(who, "set of lights", project_.lights, motion.lights, scene_lights);
                const auto* set = find_item(project_.lights, motion.lights);
                const bool is_numbered = set && !set->use_scene_lights;
                if (is_numbered && (!motion.light_name.empty() ||
                                    static_cast<std::size_t>(motion.light) >= set->lights.size()))
                    say(Severity::warning,
                        who + ": there is no such light in '" + set->id + "'; choose another");
                if (!is_numbered && motion.light_name.empty())
                    say(Severity::warning, who + ": a light of the scene's file moves by its name; give one");
                counts = motion.light_name.empty()
                             ? motion_of_light(project_, motion.lights, motion.light)
                             : motion_of_light(project_, motion.lights, motion.light_name);
                break;
            }
            case Motion::Kind::part: {
                refer(who, "scene", project_.scenes, motion.scene);
                const auto* scene = find_item(project_.scenes, motion.scene);
                if (scene && static_cast<std::size_t>(motion.part) >= scene->parts.size())
                    say(Severity::warning,
                        who + ": there is no such part in '" + scene->id + "'; choose another");
                counts = motion_of_part(project_, motion.scene, motion.part);
            }
        }
        if (counts && counts != &motion && !motion.keys.empty())
            say(Severity::warning, who + ": does not count, because '" + counts->id + "' moves the same");
    }

    template <class List>
    void refer(const std::string& who, const char* word, const List& list, const std::string& id,
               const std::string& none = "") {
        if (id != none && !id.empty() && !find_item(list, id))
            say(Severity::warning,
                who + ": there is no " + word + " '" + printable(id, 60) + "'; choose another");
    }

    void refer_to_picture(const std::string& who, const std::string& id) {
        if (!find_item(project_.images, id)) refer(who, "experiment or image", project_.experiments, id);
    }

    void references() {
        for (const auto& e : project_.experiments) {
            const std::string who = "experiment '" + e.id + "'";
            if (e.scene.empty()) say(Severity::warning, who + ": has no scene; choose one");
            refer(who, "scene", project_.scenes, e.scene);
            refer(who, "camera", project_.cameras, e.camera);
            refer(who, "set of lights", project_.lights, e.lights, scene_lights);
            refer(who, "experiment", project_.experiments, e.reference);
        }
        for (const auto& motion : project_.motion) check(motion);
        for (const auto& sweep : project_.sweeps)
            refer("sweep '" + sweep.id + "'", "experiment", project_.experiments, sweep.experiment);
        for (const auto& c : project_.comparisons)
            for (const auto& side : {c.a, c.b}) refer_to_picture("comparison '" + c.id + "'", side);
        for (const auto& plot : project_.plots) {
            const std::string who = "plot '" + plot.id + "'";
            if (plot.reference.empty()) say(Severity::warning, who + ": has no reference; choose one");
            refer_to_picture(who, plot.reference);
            for (const auto& id : plot.experiments) refer(who, "experiment", project_.experiments, id);
        }
    }

    const ReadProject& read_;
    const Project& project_;
    const fs::path& folder_;
    const Registry& registry_;
    const ContentHashes* known_;
    std::vector<Message> messages_;
};

}  // namespace

std::vector<Message> check(const ReadProject& read, const fs::path& project_folder, const Registry& registry,
                           const ContentHashes* known) {
    return Checker(read, project_folder, registry, known).run();
}

std::string why_not_runnable(const Project& project, const Experiment& experiment, const Registry& registry,
                             const fs::path& project_folder) {
    if (!registry.find(experiment.method))
        return "method '" + printable(experiment.method, 60) + "' is unknown to this build";
    const auto* scene = find_item(project.scenes, experiment.scene);
    if (!scene) return "it has no scene";
    for (const auto& part : scene->parts) {
        std::error_code ignored;
        if (!is_builtin(part.source) && !fs::is_regular_file(resolve(part.source, project_folder), ignored))
            return "scene file '" + printable(part.source) + "' is missing";
    }
    if (!experiment.camera.empty() && !find_item(project.cameras, experiment.camera))
        return "its camera '" + experiment.camera + "' is not in the project";
    if (experiment.lights != scene_lights && !find_item(project.lights, experiment.lights))
        return "its lights '" + experiment.lights + "' are not in the project";
    return "";
}

}  // namespace ir::projects
