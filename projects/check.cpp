#include "projects/check.h"

#include <algorithm>

#include "projects/analyses.h"
#include "projects/motion.h"
#include "projects/results.h"
#include "projects/scene_files.h"
#include "projects/store.h"
#include "projects/sweep.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/line_diff.h"
#include "renderers/core/named_files.h"
#include "renderers/core/resources_path.h"

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
        for (auto& message : unknown_key_messages(project_, registry_))
            messages_.push_back(std::move(message));
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
        std::error_code ignored;
        if (status.state == FileState::missing && fs::exists(status.resolved, ignored))
            say(Severity::error, what + ": " + source + " is no regular file; locate another");
        else if (status.state == FileState::missing)
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
        if (folder_.empty()) return;  // never saved: all is elsewhere
        std::vector<std::string> outside;
        for (const auto& source : sources_of(project_))
            if (!is_builtin(source) && !lies_within(resolve(source, folder_), folder_))
                outside.push_back(source);
        if (!outside.empty())
            say(Severity::note, "reads files outside of its folder: " + printable(listed(outside), 400));
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
        for (const auto& [file, hunks] : experiment.shaders) check_shader(where, file, hunks);
        if (const auto why = why_shaders_wait(project_, experiment); !why.empty())
            say(Severity::warning, where + why);
        if (is_stale(project_, experiment, registry_, known_ ? *known_ : ContentHashes{}))
            say(Severity::note, where + "its kept result is stale; render it again");
    }

    void check_shader(const std::string& where, const std::string& file, const std::string& hunks) {
        try {
            changed_shader(shader_directory(), file, hunks);
            say(Severity::note, where + "shader changed: " + file + " (" + count_lines(hunks).text() + ")");
        } catch (const Error& error) {
            say(Severity::error, where + printable(error.what(), 400));
        }
    }

    /// What is at `place`, a JSON pointer, cannot work.
    void refuse(const std::string& place, const std::string& problem) {
        say(Severity::error,
            printable((folder_ / project_file_name).string(), 400) + ": " + place + ": " + problem);
    }
    void refuse(const std::string& place, const std::string& who, const std::string& problem) {
        refuse(place, who + ": " + problem);
    }

    /// Of a sweep whose experiment is there and can run.
    void check_axes(const Sweep& sweep, const std::string& at) {
        const auto* base = find_item(project_.experiments, sweep.experiment);
        if (!base || !registry_.find(base->method)) return;
        try {
            check_sweep(project_, sweep, registry_);
        } catch (const UsageError& error) {
            refuse(at, error.what());
        }
    }

    void check(const Motion& motion, const std::string& at) {
        const std::string who = "motion '" + motion.id + "'";
        const Motion* counts = nullptr;
        switch (motion.kind) {
            case Motion::Kind::camera:
                refer(at + "/camera", who, "camera", project_.cameras, motion.camera);
                counts = motion_of_camera(project_, motion.camera);
                break;
            case Motion::Kind::light:
                refer(at + "/lights", who, "set of lights", project_.lights, motion.lights, scene_lights);
                check_light(motion, at + "/light", who);
                counts = motion.light_name.empty()
                             ? motion_of_light(project_, motion.lights, motion.light)
                             : motion_of_light(project_, motion.lights, motion.light_name);
                break;
            case Motion::Kind::part: {
                refer(at + "/scene", who, "scene", project_.scenes, motion.scene);
                const auto* scene = find_item(project_.scenes, motion.scene);
                if (scene && static_cast<std::size_t>(motion.part) >= scene->parts.size())
                    refuse(at + "/part", who, no_such("part", motion.part, scene->id, scene->parts.size()));
                counts = motion_of_part(project_, motion.scene, motion.part);
            }
        }
        if (counts && counts != &motion && !motion.keys.empty())
            say(Severity::warning, who + ": does not count, because '" + counts->id + "' moves the same");
    }

    void check_light(const Motion& motion, const std::string& at, const std::string& who) {
        const auto* set = find_item(project_.lights, motion.lights);
        if (!motion.light_name.empty()) {
            if (set && !set->use_scene_lights)
                refuse(at, who,
                       "the lights of '" + set->id + "' have no names; give a number, counted from 0");
        } else if (!set || (set->use_scene_lights && set->lights.empty())) {
            refuse(at, who, "a light of the scene's file moves by its name; give one");
        } else if (static_cast<std::size_t>(motion.light) >= set->lights.size()) {
            refuse(at, who, no_such("light", motion.light, set->id, set->lights.size()));
        }
    }

    static std::string no_such(const std::string& word, int number, const std::string& id,
                               std::size_t count) {
        return "there is no " + word + " " + std::to_string(number) + " in '" + id + "', which has " +
               std::to_string(count) + "; choose another, counted from 0";
    }

    /// `id` stands at `place`; one that is empty or `none` stands for nothing.
    template <class List>
    void refer(const std::string& place, const std::string& who, const std::string& word, const List& list,
               const std::string& id, const std::string& none = "") {
        if (id == none || id.empty() || find_item(list, id)) return;
        std::vector<std::string> known;
        for (const auto& item : list) known.push_back(item.id);
        refuse(place, who,
               "there is no " + word + " '" + printable(id, 60) + "'; " +
                   (known.empty() ? "add it" : "choose " + printable(listed(known), 200) + ", or add it"));
    }

    void refer_to_picture(const std::string& place, const std::string& who, const std::string& id) {
        if (!find_item(project_.images, id))
            refer(place, who, "experiment or image", project_.experiments, id);
    }

    /// `look(item, where it stands)` for each.
    template <class List, class Look>
    void each(const std::string& key, const List& list, Look look) {
        for (std::size_t i = 0; i < list.size(); ++i) look(list[i], pointer_to("/" + key, i));
    }

    void references() {
        each("experiments", project_.experiments, [&](const Experiment& e, const std::string& at) {
            const std::string who = "experiment '" + e.id + "'";
            if (e.scene.empty()) refuse(at + "/scene", who, "has no scene; choose one");
            refer(at + "/scene", who, "scene", project_.scenes, e.scene);
            refer(at + "/camera", who, "camera", project_.cameras, e.camera);
            refer(at + "/lights", who, "set of lights", project_.lights, e.lights, scene_lights);
            refer(at + "/reference", who, "experiment", project_.experiments, e.reference);
        });
        each("motion", project_.motion,
             [&](const Motion& motion, const std::string& at) { check(motion, at); });
        each("sweeps", project_.sweeps, [&](const Sweep& sweep, const std::string& at) {
            const std::string who = "sweep '" + sweep.id + "'";
            if (sweep.experiment.empty()) refuse(at + "/experiment", who, "has no experiment; choose one");
            refer(at + "/experiment", who, "experiment", project_.experiments, sweep.experiment);
            check_axes(sweep, at + "/axes");
        });
        each("comparisons", project_.comparisons, [&](const Comparison& c, const std::string& at) {
            const std::string who = "comparison '" + c.id + "'";
            for (const auto& [side, id] : {std::pair{"a", c.a}, {"b", c.b}}) {
                if (id.empty()) refuse(at + "/" + side, who, "has no picture on this side; choose one");
                refer_to_picture(at + "/" + side, who, id);
            }
        });
        each("plots", project_.plots, [&](const ErrorPlot& plot, const std::string& at) {
            const std::string who = "plot '" + plot.id + "'";
            if (plot.reference.empty()) refuse(at + "/reference", who, "has no reference; choose one");
            refer_to_picture(at + "/reference", who, plot.reference);
            for (const auto& id : plot.experiments)
                refer(at + "/experiments", who, "experiment", project_.experiments, id);
        });
        each("analyses", project_.analyses, [&](const Analysis& analysis, const std::string& at) {
            const auto why_not = why_not_analysed(project_, analysis, registry_);
            if (!why_not.empty()) refuse(at, "analysis '" + analysis.id + "'", why_not);
        });
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
    return why_shaders_wait(project, experiment);
}

std::string why_shaders_wait(const Project& project, const Experiment& experiment) {
    if (experiment.shaders.empty() || project.shaders_allowed || are_changed_shaders_allowed()) return "";
    return "it changes shaders (" +
           printable(listed(words_of(experiment.shaders, &ShaderChanges::value_type::first)), 300) +
           "), and comes from somebody else; look at the changes, which `project` lists and the window "
           "shows, and allow them by --allow-shaders or in the window";
}

}  // namespace ir::projects
