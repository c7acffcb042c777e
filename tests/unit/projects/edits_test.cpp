#include "projects/edits.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <set>

#include "projects/document_json.h"
#include "projects/undo_stack.h"
#include "renderers/core/error.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

using testing::registry;
using testing::sample_project;
using Random = std::mt19937;

int pick(Random& random, int count) {
    return std::uniform_int_distribution<int>(0, count - 1)(random);
}

double real(Random& random) {
    return std::uniform_real_distribution<double>(0.5, 2)(random);
}

template <class List>
std::string any_id(Random& random, const List& list) {
    return list.empty() ? "" : list[static_cast<std::size_t>(pick(random, static_cast<int>(list.size())))].id;
}

template <class Item>
Item with_new_id(const std::vector<Item>& list, Item item) {
    item.id = free_id_in(list, item.id);
    return item;
}

using Maker = std::function<EditPtr(const Project&, Random&)>;

/// Add, remove, duplicate, rename and move for one list.
template <class Item>
void add_list_makers(std::map<std::string, Maker>& makers, const std::string& word,
                     std::vector<Item> Project::*list, const Item& example) {
    makers["add " + word] = [=](const Project& p, Random& r) {
        return edits::add(p, with_new_id(p.*list, example), static_cast<std::size_t>(pick(r, 3)));
    };
    makers["remove " + word] = [=](const Project& p, Random& r) {
        return edits::remove<Item>(p, any_id(r, p.*list));
    };
    makers["duplicate " + word] = [=](const Project& p, Random& r) {
        return edits::duplicate<Item>(p, any_id(r, p.*list));
    };
    makers["rename " + word] = [=](const Project& p, Random& r) {
        return edits::rename<Item>(p, any_id(r, p.*list), "name " + std::to_string(pick(r, 1000)));
    };
    makers["move " + word] = [=](const Project& p, Random& r) {
        return edits::move<Item>(p, any_id(r, p.*list), static_cast<std::size_t>(pick(r, 4)));
    };
}

template <class Item, class Alter>
Maker changer(std::vector<Item> Project::*list, EditPtr (*change)(const Project&, const Item&), Alter alter) {
    return [=](const Project& p, Random& r) {
        const auto* found = find_item(p.*list, any_id(r, p.*list));
        if (!found) throw UsageError("nothing to change");
        Item item = *found;
        alter(item, r);
        return change(p, item);
    };
}

void add_item_makers(std::map<std::string, Maker>& m) {
    m["change camera"] = changer(&Project::cameras, edits::change_camera, [](Camera& c, Random& r) {
        c.eye = {real(r), real(r), real(r) + 5};
    });
    m["change lights"] = changer(&Project::lights, edits::change_lights, [](LightSet& s, Random& r) {
        s.environment.kind = Environment::Kind::constant;
        s.environment.constant = glm::dvec3(real(r));
    });
    m["change motion"] = changer(&Project::motion, edits::change_motion, [](Motion& motion, Random& r) {
        motion.keys.push_back(Motion::Key{});
        motion.keys.back().time = motion.keys[motion.keys.size() - 2].time + real(r);
    });
    m["change image"] = changer(&Project::images, edits::change_image,
                                [](ForeignImage& i, Random& r) { i.notes = std::to_string(pick(r, 99)); });
    m["change comparison"] = changer(&Project::comparisons, edits::change_comparison,
                                     [](Comparison& c, Random& r) { c.range = glm::dvec2(0, real(r)); });
    m["change sweep"] = changer(&Project::sweeps, edits::change_sweep, [](Sweep& s, Random& r) {
        s.axes.push_back({"seed", {pick(r, 9)}});
    });
    m["change scene"] = changer(&Project::scenes, edits::change_scene, [](Scene& s, Random& r) {
        s.parts[0].source = "elsewhere/" + std::to_string(pick(r, 99)) + ".glb";
        s.parts[0].materials["stone"].roughness = pick(r, 100) / 100.0;
    });
    m["project name"] = [](const Project& p, Random& r) {
        return edits::set_project_name(p, "name " + std::to_string(pick(r, 99)));
    };
    m["project notes"] = [](const Project& p, Random& r) {
        return edits::set_notes(p, "notes " + std::to_string(pick(r, 99)));
    };
}

void add_experiment_makers(std::map<std::string, Maker>& m) {
    const auto id = [](const Project& p, Random& r) { return any_id(r, p.experiments); };
    m["values"] = [=](const Project& p, Random& r) {
        return edits::set_values(p, registry(), id(p, r), {{"samples", std::int64_t{1 + pick(r, 8)}}});
    };
    m["transport"] = [=](const Project& p, Random& r) {
        return edits::set_values(p, registry(), id(p, r), {{"max_distance", real(r)}, {"falloff", "smooth"}});
    };
    m["reset value"] = [=](const Project& p, Random& r) {
        return edits::reset_value(p, registry(), id(p, r), "samples");
    };
    m["method"] = [=](const Project& p, Random& r) {
        return edits::set_method(p, registry(), id(p, r), pick(r, 2) ? "fog" : "plain");
    };
    m["copy transport"] = [=](const Project& p, Random& r) {
        return edits::copy_transport(p, registry(), id(p, r), id(p, r));
    };
    m["scene of"] = [=](const Project& p, Random& r) {
        return edits::set_scene_of(p, id(p, r), any_id(r, p.scenes));
    };
    m["camera of"] = [=](const Project& p, Random& r) {
        return edits::set_camera_of(p, id(p, r), any_id(r, p.cameras));
    };
    m["lights of"] = [=](const Project& p, Random& r) {
        return edits::set_lights_of(p, id(p, r), pick(r, 2) ? scene_lights : any_id(r, p.lights));
    };
    m["size"] = [=](const Project& p, Random& r) {
        return edits::set_size(p, id(p, r), {1 + pick(r, 999), 1 + pick(r, 999)});
    };
    m["seed"] = [=](const Project& p, Random& r) {
        return edits::set_seed(p, id(p, r), static_cast<std::uint64_t>(pick(r, 99)));
    };
    m["frames"] = [=](const Project& p, Random& r) { return edits::set_frames(p, id(p, r), 1 + pick(r, 9)); };
    m["time"] = [=](const Project& p, Random& r) { return edits::set_time(p, id(p, r), real(r)); };
    m["experiment notes"] = [=](const Project& p, Random& r) {
        return edits::set_experiment_notes(p, id(p, r), std::to_string(pick(r, 99)));
    };
    m["reference"] = [=](const Project& p, Random& r) { return edits::set_reference(p, id(p, r), id(p, r)); };
    m["active preset"] = [=](const Project& p, Random& r) {
        const char* names[] = {"", "paper", "preview"};
        return edits::set_active_preset(p, id(p, r), names[pick(r, 3)]);
    };
    m["preset"] = [=](const Project& p, Random& r) {
        Preset preset;
        preset.size = glm::ivec2(1 + pick(r, 99), 8);
        preset.values["samples"] = std::int64_t{1 + pick(r, 8)};
        return edits::set_preset(p, registry(), id(p, r), pick(r, 2) ? "paper" : "preview", preset);
    };
    m["remove preset"] = [=](const Project& p, Random& r) {
        return edits::remove_preset(p, id(p, r), pick(r, 2) ? "paper" : "preview");
    };
    m["group"] = [=](const Project& p, Random& r) {
        Project ahead = p;
        std::vector<EditPtr> steps;
        steps.push_back(edits::set_notes(ahead, "group " + std::to_string(pick(r, 99))));
        steps.back()->apply(ahead);
        steps.push_back(edits::set_notes(ahead, "and again"));
        steps.back()->apply(ahead);
        steps.push_back(edits::duplicate<Camera>(ahead, any_id(r, ahead.cameras)));
        return edits::group("Several things", std::move(steps));
    };
}

/// One maker for every edit that there is.
std::map<std::string, Maker> all_makers() {
    const auto sample = sample_project();
    std::map<std::string, Maker> makers;
    add_list_makers(makers, "scene", &Project::scenes, sample.scenes[0]);
    add_list_makers(makers, "camera", &Project::cameras, sample.cameras[0]);
    add_list_makers(makers, "lights", &Project::lights, sample.lights[0]);
    add_list_makers(makers, "motion", &Project::motion, sample.motion[0]);
    add_list_makers(makers, "image", &Project::images, sample.images[0]);
    add_list_makers(makers, "experiment", &Project::experiments, sample.experiments[0]);
    add_list_makers(makers, "comparison", &Project::comparisons, sample.comparisons[0]);
    add_list_makers(makers, "sweep", &Project::sweeps, sample.sweeps[0]);
    add_item_makers(makers);
    add_experiment_makers(makers);
    return makers;
}

TEST(Edits, RandomEditsOfEveryKindUndoAndRedoToTheByte) {
    const auto makers = all_makers();
    std::set<std::string> made;
    for (unsigned seed = 1; seed <= 8; ++seed) {
        Random random(seed);
        Project project = sample_project();
        UndoStack stack;
        std::vector<std::string> texts{write_project(project)};
        for (int i = 0; i < 250; ++i) {
            const auto maker = std::next(makers.begin(), pick(random, static_cast<int>(makers.size())));
            const auto before = write_project(project);
            try {
                const auto position = stack.position();
                if (!stack.push(project, maker->second(project, random))) {
                    EXPECT_EQ(write_project(project), before) << maker->first;
                    continue;
                }
                made.insert(maker->first);
                // A step may merge with the one before, or cancel it out.
                texts.resize(std::min(position, stack.position()) + (stack.position() >= position ? 1 : 0));
                texts.resize(stack.position());
                texts.push_back(write_project(project));
            } catch (const UsageError&) {
                EXPECT_EQ(write_project(project), before) << maker->first;  // refused: nothing changed
            }
        }
        // What edits produce can be saved and opened again.
        const auto last = write_project(project);
        EXPECT_EQ(write_project(testing::read(last).project), last);
        ASSERT_EQ(texts.size(), stack.position() + 1);
        for (std::size_t at = stack.position(); at > 0; --at) {
            stack.undo(project);
            ASSERT_EQ(write_project(project), texts[at - 1]) << "undoing " << stack.redo_label();
        }
        EXPECT_FALSE(stack.can_undo());
        for (std::size_t at = 1; at < texts.size(); ++at) {
            stack.redo(project);
            ASSERT_EQ(write_project(project), texts[at]) << "redoing " << stack.undo_label();
        }
        EXPECT_EQ(write_project(project), last);
    }
    for (const auto& [name, maker] : makers) EXPECT_EQ(made.count(name), 1u) << name << " was never made";
}

TEST(Edits, ValuesGoWhereTheUserSeesThem) {
    Project project = sample_project();
    UndoStack stack;
    stack.push(project, edits::set_values(project, registry(), "fog-nave", {{"samples", std::int64_t{9}}}));
    const auto& e = project.experiments[0];
    EXPECT_EQ(e.presets.at("paper").values.at("samples"), Value{std::int64_t{9}});  // overridden there
    EXPECT_EQ(e.values.at("samples"), Value{std::int64_t{16}});
    stack.push(project, edits::set_values(project, registry(), "fog-nave", {{"density", 2.0}}));
    EXPECT_EQ(e.values.at("density"), Value{2.0});
    stack.push(project, edits::set_size(project, "fog-nave", {10, 20}));
    EXPECT_EQ(e.presets.at("paper").size, glm::ivec2(10, 20));
    EXPECT_EQ(e.size, glm::ivec2(640, 480));
}

TEST(Edits, RefuseWithOneLine) {
    const Project p = sample_project();
    EXPECT_THROW(edits::set_values(p, registry(), "nobody", {}), UsageError);
    EXPECT_THROW(edits::set_values(p, registry(), "fog-nave", {{"smaples", 1.0}}), UsageError);
    EXPECT_THROW(edits::set_values(p, registry(), "fog-nave", {{"samples", std::int64_t{0}}}), UsageError);
    EXPECT_THROW(edits::set_method(p, registry(), "fog-nave", "teleport"), UsageError);
    EXPECT_THROW(edits::set_size(p, "fog-nave", {0, 1}), UsageError);
    EXPECT_THROW(edits::set_frames(p, "fog-nave", 0), UsageError);
    EXPECT_THROW(edits::set_time(p, "fog-nave", std::nan("")), UsageError);
    EXPECT_THROW(edits::add(p, p.cameras[0]), UsageError);
    EXPECT_THROW(edits::rename<Camera>(p, "orbit", ""), UsageError);
    Camera broken = p.cameras[0];
    broken.target = broken.eye;
    EXPECT_THROW(edits::change_camera(p, broken), UsageError);
    broken.id = "new";
    EXPECT_THROW(edits::add(p, broken), UsageError);
    Scene glowing = p.scenes[0];
    glowing.parts[0].materials["stone"].roughness = 2;
    EXPECT_THROW(edits::change_scene(p, glowing), UsageError);
    try {
        edits::remove<Experiment>(p, "plain-nave");
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_EQ(
            std::string(error.what()),
            "experiment 'plain-nave' is used by comparison 'both', experiment 'fog-nave'; change or remove "
            "them first");
    }
}

TEST(Edits, AnotherMethodKeepsWhatItKnowsAndAllows) {
    Project project = sample_project();
    project.experiments[0].values["samples"] = std::int64_t{6};
    edits::set_method(project, registry(), "fog-nave", "plain")->apply(project);
    const auto& e = project.experiments[0];
    EXPECT_EQ(e.method, "plain");
    EXPECT_EQ(e.values, (Settings{{"samples", std::int64_t{6}}, {"weight", 1.0}}));
    EXPECT_TRUE(e.presets.at("paper").values.empty());  // 256 is beyond plain's range
}

TEST(Edits, DuplicatesAreFresh) {
    Project project = sample_project();
    project.experiments[0].last_kept_key = "abc";
    edits::duplicate<Experiment>(project, "fog-nave")->apply(project);
    ASSERT_EQ(project.experiments.size(), 3u);
    EXPECT_EQ(project.experiments[1].id, "fog-nave-2");
    EXPECT_EQ(project.experiments[1].name, "Fog in the nave copy");
    EXPECT_EQ(project.experiments[1].last_kept_key, "");
}

TEST(Edits, NewExperimentsHaveAllDefaults) {
    const auto project = sample_project();
    const auto e = edits::new_experiment(project, registry(), "fog", "Plain nave", "church", "orbit");
    EXPECT_EQ(e.id, "plain-nave-2");
    EXPECT_EQ(e.method_version, 3);
    EXPECT_EQ(e.values, defaults(registry().at("fog").parameters));
}

EditPtr density(const Project& project, double value) {
    return edits::set_values(project, registry(), "fog-nave", {{"density", value}});
}

TEST(UndoStack, SliderDragsMergeUntilTheGestureEnds) {
    Project project = sample_project();
    UndoStack stack;
    for (const double value : {0.2, 0.3, 0.4}) stack.push(project, density(project, value));
    EXPECT_EQ(stack.position(), 1u);
    EXPECT_EQ(stack.undo_label(), "Change Density");
    stack.end_gesture();
    stack.push(project, density(project, 0.5));
    EXPECT_EQ(stack.position(), 2u);
    stack.push(project, edits::set_values(project, registry(), "fog-nave", {{"jitter", false}}));
    stack.push(project, density(project, 0.6));
    EXPECT_EQ(stack.position(), 4u);  // another key in between
    for (int i = 0; i < 3; ++i) stack.undo(project);
    EXPECT_EQ(project.experiments[0].values.at("density"), Value{0.4});
    stack.undo(project);
    EXPECT_EQ(project, sample_project());
}

TEST(UndoStack, CameraOrbitsMerge) {
    Project project = sample_project();
    UndoStack stack;
    for (int i = 1; i < 20; ++i) {
        Camera camera = project.cameras[0];
        camera.eye.x += 0.1;
        stack.push(project, edits::change_camera(project, camera));
    }
    EXPECT_EQ(stack.position(), 1u);
    stack.undo(project);
    EXPECT_EQ(project, sample_project());
}

TEST(UndoStack, ADragBackToItsStartLeavesNothing) {
    Project project = sample_project();
    UndoStack stack;
    stack.push(project, density(project, 0.7));
    EXPECT_TRUE(stack.push(project, density(project, 0.1)));
    EXPECT_EQ(stack.position(), 0u);
    EXPECT_TRUE(stack.is_clean());
    EXPECT_FALSE(stack.push(project, density(project, 0.1)));
}

TEST(UndoStack, CleanMarkFollowsSaving) {
    Project project = sample_project();
    UndoStack stack;
    EXPECT_TRUE(stack.is_clean());
    stack.push(project, density(project, 0.2));
    EXPECT_FALSE(stack.is_clean());
    stack.set_clean();
    stack.push(project, density(project, 0.3));  // does not merge into the saved step
    EXPECT_EQ(stack.position(), 2u);
    EXPECT_FALSE(stack.is_clean());
    stack.undo(project);
    EXPECT_TRUE(stack.is_clean());
    stack.undo(project);
    EXPECT_FALSE(stack.is_clean());
    stack.push(project, density(project, 0.9));  // the saved state can no longer be reached
    EXPECT_FALSE(stack.is_clean());
    stack.undo(project);
    EXPECT_FALSE(stack.is_clean());
}

TEST(UndoStack, ForgetsTheOldestBeyondItsLimit) {
    Project project = sample_project();
    UndoStack stack(3);
    for (int i = 1; i <= 5; ++i) {
        stack.push(project, edits::set_time(project, "fog-nave", i));
        stack.end_gesture();
    }
    EXPECT_EQ(stack.labels().size(), 3u);
    while (stack.can_undo()) stack.undo(project);
    EXPECT_EQ(project.experiments[0].time, 2);
    EXPECT_FALSE(stack.is_clean());
}

TEST(UndoStack, KeptResultsAreNoMatterOfUndo) {
    Project project = sample_project();
    UndoStack stack;
    stack.push(project, density(project, 0.2));
    project.experiments[0].last_kept_key = "kept";
    stack.undo(project);
    EXPECT_EQ(project.experiments[0].last_kept_key, "kept");
}

}  // namespace
}  // namespace ir::projects
