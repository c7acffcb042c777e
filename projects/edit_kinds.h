#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "projects/edits.h"
#include "renderers/core/error.h"

/// The few kinds of edits that all makers in edits.h are built from.
namespace ir::projects::edits {

/// The list that holds items of a type, and what people call such an item.
template <class Item>
struct ListOf;
// clang-format off
#define IR_ITEMS(use)                          \
    use(Scene, scenes, "scene")                \
    use(Camera, cameras, "camera")             \
    use(LightSet, lights, "set of lights")     \
    use(Motion, motion, "motion")              \
    use(ForeignImage, images, "image")         \
    use(Experiment, experiments, "experiment") \
    use(Comparison, comparisons, "comparison") \
    use(Sweep, sweeps, "sweep")                \
    use(ErrorPlot, plots, "plot")              \
    use(Analysis, analyses, "analysis")
// clang-format on
#define IR_LIST_OF(Item, list, name)                   \
    template <>                                        \
    struct ListOf<Item> {                              \
        static constexpr auto member = &Project::list; \
        static constexpr const char* word = name;      \
    };
IR_ITEMS(IR_LIST_OF)
#undef IR_LIST_OF

template <class Item>
const std::vector<Item>& list_of(const Project& project) {
    return project.*ListOf<Item>::member;
}
template <class Item>
std::vector<Item>& list_of(Project& project) {
    return project.*ListOf<Item>::member;
}

/// Throws UsageError for an unknown id.
template <class Item>
const Item& item_of(const Project& project, const std::string& id) {
    if (const auto* item = find_item(list_of<Item>(project), id)) return *item;
    throw UsageError(std::string("there is no ") + ListOf<Item>::word + " '" + id + "' in the project");
}

template <class Item>
std::size_t index_of(const Project& project, const std::string& id) {
    return static_cast<std::size_t>(&item_of<Item>(project, id) - list_of<Item>(project).data());
}

/// One item becomes another with the same id.
template <class Item>
class Replace final : public Edit {
  public:
    Replace(std::string label, std::string merge_key, Item before, Item after)
        : Edit(std::move(label), std::move(merge_key)),
          before_(std::move(before)),
          after_(std::move(after)) {}
    void apply(Project& project) override { put(project, after_); }
    void revert(Project& project) override { put(project, before_); }
    bool absorb(const Edit& later) override {
        const auto* other = dynamic_cast<const Replace*>(&later);
        if (!other || other->after_.id != after_.id) return false;
        after_ = other->after_;
        return true;
    }
    bool changes_nothing() const override { return before_ == after_; }

  private:
    static void put(Project& project, const Item& item) {
        auto* present = find_item(list_of<Item>(project), item.id);
        if (!present) throw Error("undo: item '" + item.id + "' is missing");
        *present = item;
    }
    Item before_, after_;
};

/// An item comes into its list, or goes.
template <class Item>
class Presence final : public Edit {
  public:
    Presence(std::string label, std::size_t position, Item item, bool comes)
        : Edit(std::move(label)), position_(position), item_(std::move(item)), comes_(comes) {}
    void apply(Project& project) override { comes_ ? put(project) : take(project); }
    void revert(Project& project) override { comes_ ? take(project) : put(project); }

  private:
    auto place(Project& project) const {
        return list_of<Item>(project).begin() + static_cast<std::ptrdiff_t>(position_);
    }
    void put(Project& project) { list_of<Item>(project).insert(place(project), item_); }
    void take(Project& project) {
        item_ = *place(project);
        list_of<Item>(project).erase(place(project));
    }
    std::size_t position_;
    Item item_;
    bool comes_;
};

template <class Item>
class Move final : public Edit {
  public:
    Move(std::string label, std::size_t from, std::size_t to)
        : Edit(std::move(label)), from_(from), to_(to) {}
    void apply(Project& project) override { shift(list_of<Item>(project), from_, to_); }
    void revert(Project& project) override { shift(list_of<Item>(project), to_, from_); }
    bool changes_nothing() const override { return from_ == to_; }

  private:
    static void shift(std::vector<Item>& list, std::size_t from, std::size_t to) {
        Item item = std::move(list[from]);
        list.erase(list.begin() + static_cast<std::ptrdiff_t>(from));
        list.insert(list.begin() + static_cast<std::ptrdiff_t>(to), std::move(item));
    }
    std::size_t from_, to_;
};

/// A value of the project itself.
template <class Value>
class SetMember final : public Edit {
  public:
    SetMember(std::string label, std::string merge_key, Value Project::*member, Value before, Value after)
        : Edit(std::move(label), std::move(merge_key)),
          member_(member),
          before_(std::move(before)),
          after_(std::move(after)) {}
    void apply(Project& project) override { project.*member_ = after_; }
    void revert(Project& project) override { project.*member_ = before_; }
    bool absorb(const Edit& later) override {
        const auto* other = dynamic_cast<const SetMember*>(&later);
        if (!other || other->member_ != member_) return false;
        after_ = other->after_;
        return true;
    }
    bool changes_nothing() const override { return before_ == after_; }

  private:
    Value Project::*member_;
    Value before_, after_;
};

class Group final : public Edit {
  public:
    Group(std::string label, std::vector<EditPtr> edits) : Edit(std::move(label)), edits_(std::move(edits)) {}
    /// All or nothing.
    void apply(Project& project) override {
        std::size_t done = 0;
        try {
            for (; done < edits_.size(); ++done) edits_[done]->apply(project);
        } catch (...) {
            while (done > 0) edits_[--done]->revert(project);
            throw;
        }
    }
    void revert(Project& project) override {
        for (auto edit = edits_.rbegin(); edit != edits_.rend(); ++edit) (*edit)->revert(project);
    }
    bool changes_nothing() const override {
        return std::all_of(edits_.begin(), edits_.end(), [](const auto& e) { return e->changes_nothing(); });
    }

  private:
    std::vector<EditPtr> edits_;
};

/// The replacement of an item that is in the project.
template <class Item>
EditPtr replace(const Project& project, const Item& after, std::string label, std::string merge_key) {
    return std::make_unique<Replace<Item>>(std::move(label), std::move(merge_key),
                                           item_of<Item>(project, after.id), after);
}

}  // namespace ir::projects::edits
