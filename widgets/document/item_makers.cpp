#include <algorithm>
#include <functional>
#include <numeric>

#include "projects/edit_kinds.h"
#include "renderers/core/error.h"
#include "widgets/document/makers.h"
#include "widgets/document/replaced.h"

namespace ir::widgets::makers {
namespace {

using projects::EditPtr;
using projects::LightSet;
using projects::Project;
using projects::Scene;
namespace edits = projects::edits;

std::size_t clamped(int position, std::size_t count) {
    return std::min(std::size_t(std::max(position, 0)), count - 1);
}

template <class T>
void shift(std::vector<T>& list, std::size_t from, std::size_t to) {
    T item = std::move(list[from]);
    list.erase(list.begin() + std::ptrdiff_t(from));
    list.insert(list.begin() + std::ptrdiff_t(to), std::move(item));
}

template <class T>
void repeat(std::vector<T>& list, std::size_t index) {
    T copy = list[index];
    list.insert(list.begin() + std::ptrdiff_t(index) + 1, std::move(copy));
}

template <class T>
void erase(std::vector<T>& list, std::size_t index) {
    list.erase(list.begin() + std::ptrdiff_t(index));
}

/// The edit, and motions of things that stand elsewhere in their list after `work`, as one step.
template <class Work>
EditPtr with_motions(const Project& project, EditPtr edit, std::size_t count, std::size_t index,
                     int projects::Motion::*member, const std::function<bool(const projects::Motion&)>& moves,
                     Work work) {
    std::vector<int> order(count);
    std::iota(order.begin(), order.end(), 0);
    work(order, index);
    std::vector<EditPtr> steps;
    for (auto motion : project.motion) {
        if (!moves(motion) || std::size_t(motion.*member) >= count) continue;
        const auto place = std::find(order.begin(), order.end(), motion.*member);
        if (place == order.end())
            throw UsageError("it is moved by motion '" + projects::printable(motion.name, 40) +
                             "'; change or remove that first");
        if (place - order.begin() == motion.*member) continue;
        motion.*member = int(place - order.begin());
        steps.push_back(projects::edits::replace(project, motion, "", ""));
    }
    if (steps.empty()) return edit;
    const auto label = edit->label();
    steps.insert(steps.begin(), std::move(edit));
    return edits::group(label, std::move(steps));
}

/// Changes the parts of a scene as one step.
template <class Work>
EditPtr with_parts(const Project& project, const ItemRef& item, const std::string& label, Work work) {
    Scene scene = edits::item_of<Scene>(project, item.id.toStdString());
    const auto count = scene.parts.size(), index = checked_index(item.index, count, "part");
    work(scene.parts, index);
    const auto moves = [&](const projects::Motion& motion) {
        return motion.kind == projects::Motion::Kind::part && motion.scene == scene.id;
    };
    return with_motions(project, replaced(project, scene, label), count, index, &projects::Motion::part,
                        moves, work);
}

/// Changes the lights of a set as one step; unknown keys go along with their light.
template <class Work>
EditPtr with_lights(const Project& project, const ItemRef& item, const std::string& label, Work work) {
    LightSet set = edits::item_of<LightSet>(project, item.id.toStdString());
    const auto count = set.lights.size(), index = checked_index(item.index, count, "light");
    set.light_extras.resize(set.lights.size(), projects::Json::object());
    work(set.lights, index);
    work(set.light_extras, index);
    while (!set.light_extras.empty() && set.light_extras.back().empty()) set.light_extras.pop_back();
    const auto moves = [&](const projects::Motion& motion) {
        return motion.kind == projects::Motion::Kind::light && motion.lights == set.id &&
               motion.light_name.empty();
    };
    return with_motions(project, replaced(project, set, label), count, index, &projects::Motion::light, moves,
                        work);
}

/// Calls `work` with the type of the item's list; parts, lights and the project have none.
template <class Work>
EditPtr for_type(ItemKind kind, Work work) {
    switch (kind) {
        case ItemKind::scene:
            return work.template operator()<Scene>();
        case ItemKind::camera:
            return work.template operator()<projects::Camera>();
        case ItemKind::light_set:
            return work.template operator()<LightSet>();
        case ItemKind::motion:
            return work.template operator()<projects::Motion>();
        case ItemKind::experiment:
            return work.template operator()<projects::Experiment>();
        case ItemKind::comparison:
            return work.template operator()<projects::Comparison>();
        case ItemKind::image:
            return work.template operator()<projects::ForeignImage>();
        case ItemKind::sweep:
            return work.template operator()<projects::Sweep>();
        case ItemKind::plot:
            return work.template operator()<projects::ErrorPlot>();
        case ItemKind::analysis:
            return work.template operator()<projects::Analysis>();
        default:
            throw UsageError("select an item of the project first");
    }
}

}  // namespace

EditMaker remove(const ItemRef& item) {
    return [=](const Project& project) {
        const auto drop = [](auto& list, std::size_t index) { erase(list, index); };
        if (item.kind == ItemKind::part) return with_parts(project, item, "Remove a file of scene", drop);
        if (item.kind == ItemKind::light) return with_lights(project, item, "Remove a light of", drop);
        if (item.kind == ItemKind::project) throw UsageError("the project itself cannot be removed");
        return for_type(item.kind,
                        [&]<class Item>() { return edits::remove<Item>(project, item.id.toStdString()); });
    };
}

EditMaker duplicate(const ItemRef& item) {
    return [=](const Project& project) {
        const auto copy = [](auto& list, std::size_t index) { repeat(list, index); };
        if (item.kind == ItemKind::part) return with_parts(project, item, "Duplicate a file of scene", copy);
        if (item.kind == ItemKind::light) return with_lights(project, item, "Duplicate a light of", copy);
        if (item.kind == ItemKind::project)
            throw UsageError("the project itself cannot be duplicated here; use Save as");
        return for_type(item.kind,
                        [&]<class Item>() { return edits::duplicate<Item>(project, item.id.toStdString()); });
    };
}

EditMaker rename(const ItemRef& item, const std::string& name) {
    return [=](const Project& project) {
        if (item.kind == ItemKind::project) return edits::set_project_name(project, name);
        return for_type(item.kind, [&]<class Item>() {
            return edits::rename<Item>(project, item.id.toStdString(), name);
        });
    };
}

EditMaker move(const ItemRef& item, int position) {
    return [=](const Project& project) {
        const auto put = [position](auto& list, std::size_t index) {
            shift(list, index, clamped(position, list.size()));
        };
        if (item.kind == ItemKind::part) return with_parts(project, item, "Move a file of scene", put);
        if (item.kind == ItemKind::light) return with_lights(project, item, "Move a light of", put);
        return for_type(item.kind, [&]<class Item>() {
            return edits::move<Item>(project, item.id.toStdString(), std::size_t(std::max(position, 0)));
        });
    };
}

}  // namespace ir::widgets::makers
