#include "projects/edits.h"
#include "projects/edit_kinds.h"
#include "projects/names.h"
#include "projects/text.h"
#include "projects/validate.h"

namespace ir::projects::edits {
namespace {

std::string in_quotes(const std::string& name) {
    return "'" + printable(name, 40) + "'";
}

/// As people see it: by its name, or by its id where it has none.
template <class Item>
std::string called(const Item& item) {
    return in_quotes(item.name.empty() ? item.id : item.name);
}

template <class Item, class Refers>
void collect(std::vector<std::string>& users, const Project& project, Refers refers) {
    for (const auto& item : list_of<Item>(project))
        if (refers(item)) users.push_back(std::string(ListOf<Item>::word) + " " + called(item));
}

/// Who would be left with a reference to nothing.
std::vector<std::string> users_of(const Project& project, const Scene& scene) {
    std::vector<std::string> users;
    collect<Experiment>(users, project, [&](const auto& e) { return e.scene == scene.id; });
    collect<Motion>(users, project,
                    [&](const auto& m) { return m.kind == Motion::Kind::part && m.scene == scene.id; });
    return users;
}

std::vector<std::string> users_of(const Project& project, const Camera& camera) {
    std::vector<std::string> users;
    collect<Experiment>(users, project, [&](const auto& e) { return e.camera == camera.id; });
    collect<Motion>(users, project,
                    [&](const auto& m) { return m.kind == Motion::Kind::camera && m.camera == camera.id; });
    return users;
}

std::vector<std::string> users_of(const Project& project, const LightSet& set) {
    std::vector<std::string> users;
    collect<Experiment>(users, project, [&](const auto& e) { return e.lights == set.id; });
    collect<Motion>(users, project,
                    [&](const auto& m) { return m.kind == Motion::Kind::light && m.lights == set.id; });
    return users;
}

/// Whether a plot or an analysis names the experiment or image.
bool is_about(const auto& item, const std::string& id) {
    return item.reference == id ||
           std::find(item.experiments.begin(), item.experiments.end(), id) != item.experiments.end();
}

std::vector<std::string> users_of(const Project& project, const Experiment& experiment) {
    const auto& id = experiment.id;
    std::vector<std::string> users;
    collect<Comparison>(users, project, [&](const auto& c) { return c.a == id || c.b == id; });
    collect<Sweep>(users, project, [&](const auto& s) { return s.experiment == id; });
    collect<Experiment>(users, project, [&](const auto& e) { return e.id != id && e.reference == id; });
    collect<ErrorPlot>(users, project, [&](const auto& p) { return is_about(p, id); });
    collect<Analysis>(users, project, [&](const auto& a) { return is_about(a, id); });
    return users;
}

std::vector<std::string> users_of(const Project& project, const ForeignImage& image) {
    std::vector<std::string> users;
    collect<Comparison>(users, project, [&](const auto& c) { return c.a == image.id || c.b == image.id; });
    collect<ErrorPlot>(users, project, [&](const auto& p) { return p.reference == image.id; });
    collect<Analysis>(users, project, [&](const auto& a) { return a.reference == image.id; });
    return users;
}

template <class Item>
std::vector<std::string> users_of(const Project&, const Item&) {
    return {};
}

/// What a copy does not share with its original.
template <class Item>
void make_fresh(const Project& project, Item& copy) {
    copy.id = free_id_in(list_of<Item>(project), copy.id);
}
void make_fresh(const Project& project, Experiment& copy) {
    copy.id = free_experiment_id(project, copy.id);
    copy.last_kept_key.clear();
}

/// One replacement for every item that differs; the lists hold the same ids in the same order.
template <class Item>
void replace_changed(std::vector<EditPtr>& steps, const Project& before, const Project& after,
                     const std::string& label) {
    const auto& old_items = list_of<Item>(before);
    const auto& new_items = list_of<Item>(after);
    for (std::size_t i = 0; i < old_items.size(); ++i) {
        if (old_items[i] == new_items[i]) continue;
        validate(new_items[i]);
        steps.push_back(replace(before, new_items[i], label, ""));
    }
}

}  // namespace

template <class Item>
EditPtr add(const Project& project, const Item& item, std::optional<std::size_t> position) {
    const std::string word = ListOf<Item>::word;
    const auto& list = list_of<Item>(project);
    validate(item);
    if (find_item(list, item.id))
        throw UsageError(word + " '" + item.id + "' exists already; take another id");
    const auto index = std::min(position.value_or(list.size()), list.size());
    return std::make_unique<Presence<Item>>("Add " + word + " " + in_quotes(item.name), index, item, true);
}

template <class Item>
EditPtr remove(const Project& project, const std::string& id) {
    const auto& item = item_of<Item>(project, id);
    const auto users = users_of(project, item);
    if (!users.empty())
        throw UsageError(std::string(ListOf<Item>::word) + " " + called(item) + " is used by " +
                         listed(users) + "; change or remove them first");
    return std::make_unique<Presence<Item>>(
        std::string("Remove ") + ListOf<Item>::word + " " + in_quotes(item.name), index_of<Item>(project, id),
        item, false);
}

template <class Item>
EditPtr duplicate(const Project& project, const std::string& id) {
    const auto index = index_of<Item>(project, id);
    Item copy = item_of<Item>(project, id);
    const std::string label = std::string("Duplicate ") + ListOf<Item>::word + " " + in_quotes(copy.name);
    copy.name += " copy";
    make_fresh(project, copy);
    return std::make_unique<Presence<Item>>(label, index + 1, std::move(copy), true);
}

template <class Item>
EditPtr rename(const Project& project, const std::string& id, const std::string& name) {
    Item item = item_of<Item>(project, id);
    if (name.empty()) throw UsageError(std::string(ListOf<Item>::word) + " '" + id + "' needs a name");
    item.name = name;
    const auto label = std::string("Rename ") + ListOf<Item>::word;
    auto edit = replace(project, item, label, "");
    if constexpr (std::is_same_v<Item, Experiment>) {
        auto steps = following_names(project, item, true);
        steps.push_back(std::move(edit));
        return group(label, std::move(steps));
    }
    return edit;
}

template <class Item>
EditPtr move(const Project& project, const std::string& id, std::size_t position) {
    const auto from = index_of<Item>(project, id);
    const auto last = list_of<Item>(project).size() - 1;
    return std::make_unique<Move<Item>>(std::string("Move ") + ListOf<Item>::word, from,
                                        std::min(position, last));
}

template <class Item>
EditPtr change(const Project& project, const Item& item) {
    validate(item);
    const std::string word = ListOf<Item>::word;
    return replace(project, item, "Change " + word + " " + in_quotes(item.name), word + ":" + item.id);
}

#define IR_LIST_EDITS(Item, list, word)                                                    \
    template EditPtr add<Item>(const Project&, const Item&, std::optional<std::size_t>);   \
    template EditPtr remove<Item>(const Project&, const std::string&);                     \
    template EditPtr duplicate<Item>(const Project&, const std::string&);                  \
    template EditPtr rename<Item>(const Project&, const std::string&, const std::string&); \
    template EditPtr change<Item>(const Project&, const Item&);                            \
    template EditPtr move<Item>(const Project&, const std::string&, std::size_t);
IR_ITEMS(IR_LIST_EDITS)
#undef IR_LIST_EDITS

EditPtr relocate(const Project& project, const std::map<std::string, std::string>& new_sources) {
    Project after = project;
    for_each_file(after, [&](std::string& source, const std::string&) {
        if (const auto found = new_sources.find(source); found != new_sources.end()) source = found->second;
    });
    const std::string label = "Locate files";
    std::vector<EditPtr> steps;
    replace_changed<Scene>(steps, project, after, label);
    replace_changed<LightSet>(steps, project, after, label);
    replace_changed<ForeignImage>(steps, project, after, label);
    return group(label, std::move(steps));
}

EditPtr set_project_name(const Project& project, const std::string& name) {
    return std::make_unique<SetMember<std::string>>("Rename project", "", &Project::name, project.name, name);
}

EditPtr set_notes(const Project& project, const std::string& notes) {
    return std::make_unique<SetMember<std::string>>("Change notes", "notes", &Project::notes, project.notes,
                                                    notes);
}

EditPtr set_shaders_allowed(const Project& project, bool allowed) {
    return std::make_unique<SetMember<bool>>(allowed ? "Allow changed shaders" : "Forbid changed shaders", "",
                                             &Project::shaders_allowed, project.shaders_allowed, allowed);
}

EditPtr group(std::string label, std::vector<EditPtr> edits) {
    return std::make_unique<Group>(std::move(label), std::move(edits));
}

}  // namespace ir::projects::edits
