#include "projects/document_json.h"
#include "projects/text.h"
#include "renderers/core/transport.h"

namespace ir::projects {
namespace {

class Collector {
  public:
    explicit Collector(const Registry& registry) : registry_(registry) {}

    std::vector<std::string> keys;

    void extra(const std::string& pointer, const Json& extra) {
        for (auto it = extra.begin(); it != extra.end(); ++it) keys.push_back(pointer_to(pointer, it.key()));
    }

    template <class List, class Inner>
    void list(const std::string& name, const List& items, Inner inner) {
        for (std::size_t i = 0; i < items.size(); ++i) {
            const auto pointer = pointer_to("/" + name, i);
            inner(pointer, items[i]);
            extra(pointer, items[i].extra);
        }
    }

    /// Values are unknown when their method is known and does not have them.
    void values(const std::string& pointer, const std::string& method_id, const Settings& values,
                const Json& extra_values, const Json& extra_transport) {
        const auto* method = registry_.find(method_id);
        for (const auto& [key, value] : values)
            if (method && !find(method->parameters, key)) keys.push_back(place(pointer, key));
        for (auto it = extra_values.begin(); it != extra_values.end(); ++it)
            if (method) keys.push_back(place(pointer, it.key()));
        extra(pointer + "/transport", extra_transport);
    }

    void experiment(const std::string& pointer, const Experiment& e) {
        values(pointer, e.method, e.values, e.extra_values, e.extra_transport);
        for (const auto& [name, preset] : e.presets) {
            const auto inner = pointer_to(pointer + "/presets", name);
            values(inner, e.method, preset.values, preset.extra_values, preset.extra_transport);
            extra(inner, preset.extra);
        }
    }

  private:
    static std::string place(const std::string& pointer, const std::string& key) {
        return pointer_to(pointer + (is_transport_key(key) ? "/transport" : "/values"), key);
    }

    const Registry& registry_;
};

}  // namespace

std::vector<std::string> unknown_keys(const Project& project, const Registry& registry) {
    Collector found(registry);
    const auto nothing = [](const std::string&, const auto&) {};
    found.list("scenes", project.scenes, [&](const std::string& pointer, const Scene& scene) {
        for (std::size_t i = 0; i < scene.parts.size(); ++i) {
            const auto part = pointer_to(pointer + "/parts", i);
            for (const auto& [name, change] : scene.parts[i].materials)
                found.extra(pointer_to(part + "/materials", name), change.extra);
            found.extra(part, scene.parts[i].extra);
        }
    });
    found.list("cameras", project.cameras, nothing);
    found.list("lights", project.lights, [&](const std::string& pointer, const LightSet& set) {
        for (std::size_t i = 0; i < set.light_extras.size(); ++i)
            found.extra(pointer_to(pointer + "/lights", i), set.light_extras[i]);
        found.extra(pointer + "/environment", set.environment.extra);
    });
    found.list("motion", project.motion, [&](const std::string& pointer, const Motion& motion) {
        for (std::size_t i = 0; i < motion.keys.size(); ++i)
            found.extra(pointer_to(pointer + "/keys", i), motion.keys[i].extra);
    });
    found.list("images", project.images, nothing);
    found.list("experiments", project.experiments,
               [&](const std::string& pointer, const Experiment& e) { found.experiment(pointer, e); });
    found.list("comparisons", project.comparisons, nothing);
    found.list("sweeps", project.sweeps, [&](const std::string& pointer, const Sweep& sweep) {
        for (std::size_t i = 0; i < sweep.axes.size(); ++i)
            found.extra(pointer_to(pointer + "/axes", i), sweep.axes[i].extra);
    });
    found.list("plots", project.plots, nothing);
    found.list("analyses", project.analyses, nothing);
    auto extra = project.extra;
    extra.erase("$schema");  // for editors: where the JSON Schema is
    found.extra("", extra);
    return found.keys;
}

std::vector<Message> unknown_key_messages(const Project& project, const Registry& registry) {
    std::vector<Message> messages;
    for (const auto& key : unknown_keys(project, registry))
        messages.push_back(
            {Severity::warning, "project", "unknown key " + printable(key) + " is kept and ignored"});
    return messages;
}

}  // namespace ir::projects
