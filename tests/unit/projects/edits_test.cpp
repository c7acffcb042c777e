#include "projects/edits.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>
#include <regex>
#include <set>

#include "projects/document_json.h"
#include "projects/scene_files.h"
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
void add_list_makers(std::map<std::string, Maker>& makers, const std::string& item,
                     std::vector<Item> Project::*list, const Item& example) {
    makers["add<" + item + ">"] = [=](const Project& p, Random& r) {
        return edits::add(p, with_new_id(p.*list, example), static_cast<std::size_t>(pick(r, 3)));
    };
    makers["remove<" + item + ">"] = [=](const Project& p, Random& r) {
        return edits::remove<Item>(p, any_id(r, p.*list));
    };
    makers["duplicate<" + item + ">"] = [=](const Project& p, Random& r) {
        return edits::duplicate<Item>(p, any_id(r, p.*list));
    };
    makers["rename<" + item + ">"] = [=](const Project& p, Random& r) {
        return edits::rename<Item>(p, any_id(r, p.*list), "name " + std::to_string(pick(r, 1000)));
    };
    makers["move<" + item + ">"] = [=](const Project& p, Random& r) {
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
    m["change<Camera>"] = changer(&Project::cameras, edits::change<Camera>, [](Camera& c, Random& r) {
        c.eye = {real(r), real(r), real(r) + 5};
    });
    m["change<LightSet>"] = changer(&Project::lights, edits::change<LightSet>, [](LightSet& s, Random& r) {
        s.environment.kind = Environment::Kind::constant;
        s.environment.constant = glm::dvec3(real(r));
    });
    m["change<Motion>"] = changer(&Project::motion, edits::change<Motion>, [](Motion& motion, Random& r) {
        motion.keys.push_back(motion.keys.back());
        motion.keys.back().eye.x += 1;
        motion.keys.back().time = motion.keys[motion.keys.size() - 2].time + real(r);
    });
    m["change<Experiment>"] =
        changer(&Project::experiments, edits::change<Experiment>,
                [](Experiment& e, Random& r) { e.notes = "note " + std::to_string(pick(r, 99)); });
    m["change<ForeignImage>"] =
        changer(&Project::images, edits::change<ForeignImage>,
                [](ForeignImage& i, Random& r) { i.notes = std::to_string(pick(r, 99)); });
    m["change<Comparison>"] = changer(&Project::comparisons, edits::change<Comparison>,
                                      [](Comparison& c, Random& r) { c.range = glm::dvec2(0, real(r)); });
    m["change<Sweep>"] = changer(&Project::sweeps, edits::change<Sweep>, [](Sweep& s, Random& r) {
        s.axes.push_back({"seed", {pick(r, 9)}});
    });
    m["change<ErrorPlot>"] =
        changer(&Project::plots, edits::change<ErrorPlot>, [](ErrorPlot& plot, Random& r) {
            plot.values.push_back(pick(r, 9));
            plot.against_time = pick(r, 2) == 0;
            plot.metric = pick(r, 2) ? "rmse" : "flip";
        });
    m["change<Analysis>"] =
        changer(&Project::analyses, edits::change<Analysis>,
                [](Analysis& analysis, Random& r) { analysis.parameters = {std::to_string(pick(r, 100))}; });
    m["change<Scene>"] = changer(&Project::scenes, edits::change<Scene>, [](Scene& s, Random& r) {
        s.parts[0].source = "elsewhere/" + std::to_string(pick(r, 99)) + ".glb";
        s.parts[0].materials["stone"].roughness = pick(r, 100) / 100.0;
    });
    m["relocate"] = [](const Project& p, Random& r) {
        const auto sources = sources_of(p);
        if (sources.empty()) throw UsageError("nothing to locate");
        const auto source = std::next(sources.begin(), pick(r, static_cast<int>(sources.size())));
        return edits::relocate(p, {{*source, "found/" + std::to_string(pick(r, 999)) + ".glb"}});
    };
    m["set_project_name"] = [](const Project& p, Random& r) {
        return edits::set_project_name(p, "name " + std::to_string(pick(r, 99)));
    };
    m["set_notes"] = [](const Project& p, Random& r) {
        return edits::set_notes(p, "notes " + std::to_string(pick(r, 99)));
    };
    m["set_shaders_allowed"] = [](const Project& p, Random&) {
        return edits::set_shaders_allowed(p, !p.shaders_allowed);
    };
}

void add_experiment_makers(std::map<std::string, Maker>& m) {
    const auto id = [](const Project& p, Random& r) { return any_id(r, p.experiments); };
    m["set_values"] = [=](const Project& p, Random& r) {
        const Settings values = pick(r, 2) ? Settings{{"samples", std::int64_t{1 + pick(r, 8)}}}
                                           : Settings{{"max_distance", real(r)}, {"falloff", "smooth"}};
        return edits::set_values(p, registry(), id(p, r), values);
    };
    m["reset_value"] = [=](const Project& p, Random& r) {
        return edits::reset_value(p, registry(), id(p, r), "samples");
    };
    m["set_method"] = [=](const Project& p, Random& r) {
        return edits::set_method(p, registry(), id(p, r), pick(r, 2) ? "fog" : "plain");
    };
    m["set_scene_of"] = [=](const Project& p, Random& r) {
        return edits::set_scene_of(p, id(p, r), any_id(r, p.scenes));
    };
    m["set_camera_of"] = [=](const Project& p, Random& r) {
        return edits::set_camera_of(p, id(p, r), any_id(r, p.cameras));
    };
    m["set_lights_of"] = [=](const Project& p, Random& r) {
        return edits::set_lights_of(p, id(p, r), pick(r, 2) ? scene_lights : any_id(r, p.lights));
    };
    m["set_size"] = [=](const Project& p, Random& r) {
        return edits::set_size(p, id(p, r), {1 + pick(r, 999), 1 + pick(r, 999)});
    };
    m["set_seed"] = [=](const Project& p, Random& r) {
        return edits::set_seed(p, id(p, r), static_cast<std::uint64_t>(pick(r, 99)));
    };
    m["set_frames"] = [=](const Project& p, Random& r) {
        return edits::set_frames(p, id(p, r), 1 + pick(r, 9));
    };
    m["set_time"] = [=](const Project& p, Random& r) { return edits::set_time(p, id(p, r), real(r)); };
    m["set_shader"] = [=](const Project& p, Random& r) {
        const auto file = "lib/" + std::to_string(pick(r, 3)) + ".glsl";
        return edits::set_shader(p, id(p, r), file, pick(r, 3) == 0 ? "" : "@@ -1,1 +1,1 @@\n-a\n+b\n");
    };
    m["set_experiment_notes"] = [=](const Project& p, Random& r) {
        return edits::set_experiment_notes(p, id(p, r), std::to_string(pick(r, 99)));
    };
    m["set_reference"] = [=](const Project& p, Random& r) {
        return edits::set_reference(p, id(p, r), id(p, r));
    };
    m["set_active_preset"] = [=](const Project& p, Random& r) {
        const char* names[] = {"", "paper", "preview"};
        return edits::set_active_preset(p, id(p, r), names[pick(r, 3)]);
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

/// A generator of random edits for every maker in edits.h, by its name there.
std::map<std::string, Maker> all_makers() {
    const auto sample = sample_project();
    std::map<std::string, Maker> makers;
    add_list_makers(makers, "Scene", &Project::scenes, sample.scenes[0]);
    add_list_makers(makers, "Camera", &Project::cameras, sample.cameras[0]);
    add_list_makers(makers, "LightSet", &Project::lights, sample.lights[0]);
    add_list_makers(makers, "Motion", &Project::motion, sample.motion[0]);
    add_list_makers(makers, "ForeignImage", &Project::images, sample.images[0]);
    add_list_makers(makers, "Experiment", &Project::experiments, sample.experiments[0]);
    add_list_makers(makers, "Comparison", &Project::comparisons, sample.comparisons[0]);
    add_list_makers(makers, "Sweep", &Project::sweeps, sample.sweeps[0]);
    add_list_makers(makers, "ErrorPlot", &Project::plots, sample.plots[0]);
    Analysis analysis;
    analysis.id = "what-matters";
    analysis.name = "What matters";
    add_list_makers(makers, "Analysis", &Project::analyses, analysis);
    add_item_makers(makers);
    add_experiment_makers(makers);
    return makers;
}

std::set<std::string> matches(const std::string& text, const std::string& pattern) {
    const std::regex regex(pattern);
    std::set<std::string> found;
    for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
        found.insert((*match)[1]);
    return found;
}

/// The makers as the header declares them, templates once for each list of the document.
std::set<std::string> declared_makers() {
    const auto header = testing::read_text(SOURCE_ROOT "/projects/edits.h");
    const auto document = testing::read_text(SOURCE_ROOT "/projects/document.h");
    const auto lists = document.substr(document.find("struct Project {"));
    const auto items = matches(lists.substr(0, lists.find("};")), "std::vector<(\\w+)> \\w+;");
    const auto templates = matches(header, "template <class Item>\\s+EditPtr (\\w+)\\(");
    std::set<std::string> declared;
    for (const auto& name : matches(header, "EditPtr (\\w+)\\(")) {
        if (templates.count(name) == 0) declared.insert(name);
        if (templates.count(name) != 0)
            for (const auto& item : items) declared.insert(name + "<" + item + ">");
    }
    return declared;
}

TEST(Edits, EveryMakerInTheHeaderIsTestedBelow) {
    std::set<std::string> tested;
    for (const auto& [name, maker] : all_makers()) tested.insert(name);
    const auto declared = declared_makers();
    EXPECT_GT(declared.size(), 60u);
    EXPECT_EQ(tested, declared) << "give each maker of edits.h a generator of random edits";
}

/// The sample with keys from the future wherever the format keeps them, values of no known type, and presets.
Project rich_project() {
    Json json = to_json(sample_project());
    std::vector<Json*> open{&json};
    while (!open.empty()) {
        Json& at = *open.back();
        open.pop_back();
        std::vector<Json*> inner;
        for (auto it = at.begin(); it != at.end(); ++it) {
            const bool is_list_of_names =
                at.is_object() && (it.key() == "presets" || it.key() == "materials");
            if (is_list_of_names)
                for (auto& named : *it) inner.push_back(&named);
            else if (it->is_structured())
                inner.push_back(&*it);
        }
        open.insert(open.end(), inner.begin(), inner.end());
        // Last: it moves the members.
        if (at.is_object() && inner.empty()) at["from_the_future"] = {{"deep", {1, 2.5, "x", nullptr}}};
    }
    json["from_the_future"] = true;
    json["experiments"][0]["from_the_future"] = "kept";
    json["experiments"][0]["presets"]["paper"]["from_the_future"] = 1.5;
    return testing::read(pretty_json(json)).project;
}

/// A document with its history and the text of every state that undo and redo can reach.
class Walk {
  public:
    explicit Walk(unsigned seed) : random(seed) {}

    Random random;
    Project project = rich_project();
    UndoStack stack;
    std::vector<std::string> texts{write_project(project)};

    /// Whether the edit was valid and changed something; when not, nothing did.
    bool push(const std::string& name, const Maker& maker) {
        const auto before = texts.back();
        const auto position = stack.position();
        try {
            if (!stack.push(project, maker(project, random))) {
                EXPECT_EQ(write_project(project), before) << name;
                return false;
            }
        } catch (const UsageError& error) {
            EXPECT_EQ(write_project(project), before) << name;
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            return false;
        }
        // A step may merge with the one before, or cancel it out.
        texts.resize(std::min(position, stack.position()) + (stack.position() >= position ? 1 : 0));
        texts.resize(stack.position());
        texts.push_back(write_project(project));
        return true;
    }

    /// To the start and back again, every state to the byte.
    void undo_and_redo_all() {
        const auto last = write_project(project);
        // What edits produce can be saved and opened again.
        EXPECT_EQ(write_project(testing::read(last).project), last);
        ASSERT_EQ(texts.size(), stack.position() + 1);
        for (std::size_t at = stack.position(); at > 0; --at) {
            stack.undo(project);
            ASSERT_EQ(write_project(project), texts[at - 1]) << "undoing " << stack.redo_label();
        }
        EXPECT_FALSE(stack.can_undo());
        EXPECT_TRUE(stack.is_clean());
        EXPECT_EQ(project, rich_project());
        for (std::size_t at = 1; at < texts.size(); ++at) {
            stack.redo(project);
            ASSERT_EQ(write_project(project), texts[at]) << "redoing " << stack.undo_label();
        }
        EXPECT_EQ(write_project(project), last);
        EXPECT_FALSE(stack.can_redo());
    }
};

TEST(Edits, TwelveOfEveryKindUndoAndRedoToTheByte) {
    const auto makers = all_makers();
    unsigned seed = 0;
    for (const auto& [name, maker] : makers) {
        Walk walk(++seed);
        int made = 0;
        for (int tries = 0; made < 12 && tries < 400; ++tries) {
            const bool is_made = walk.push(name, maker);
            made += is_made;
            walk.stack.end_gesture();  // each a step of its own
            if (is_made) continue;
            // Something new to work on: removing runs out of what nothing refers to, and the like.
            const auto item = name.find('<');
            const auto useful = item != std::string::npos ? "add" + name.substr(item) : "set_values";
            const auto other = tries % 2 == 0 ? makers.find(useful)
                                              : std::next(makers.begin(),
                                                          pick(walk.random, static_cast<int>(makers.size())));
            walk.push(other->first, other->second);
            walk.stack.end_gesture();
        }
        EXPECT_GE(made, 12) << name;
        walk.undo_and_redo_all();
        if (HasFailure()) FAIL() << name;
    }
}

TEST(Edits, LongMixturesWithMergesUndoAndRedoToTheByte) {
    const auto makers = all_makers();
    for (unsigned seed = 1; seed <= 2; ++seed) {
        Walk walk(seed);
        std::size_t changes = 0;
        for (int i = 0; i < 200; ++i) {
            const auto maker = std::next(makers.begin(), pick(walk.random, static_cast<int>(makers.size())));
            for (int drag = pick(walk.random, 3); drag >= 0; --drag)
                changes += walk.push(maker->first, maker->second);
        }
        EXPECT_GT(changes, walk.stack.position()) << "some must merge";
        walk.undo_and_redo_all();
    }
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
    EXPECT_THROW(edits::change(p, broken), UsageError);
    broken.id = "new";
    EXPECT_THROW(edits::add(p, broken), UsageError);
    Scene glowing = p.scenes[0];
    glowing.parts[0].materials["stone"].roughness = 2;
    EXPECT_THROW(edits::change(p, glowing), UsageError);
    try {
        edits::remove<Experiment>(p, "plain-nave");
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_EQ(std::string(error.what()),
                  "experiment 'Plain' is used by comparison 'Both', experiment 'Fog in the nave', plot "
                  "'Error of the fog'; change or remove them first");
    }
}

TEST(Edits, AnotherMethodTakesNothingOverByAnEqualKey) {
    Project project = sample_project();
    project.experiments[0].values["samples"] = std::int64_t{6};
    project.experiments[0].presets["paper"].values["samples"] = std::int64_t{7};
    edits::set_method(project, registry(), "fog-nave", "plain")->apply(project);
    const auto& e = project.experiments[0];
    EXPECT_EQ(e.method, "plain");
    EXPECT_EQ(e.method_version, 1);
    EXPECT_EQ(e.values, defaults(registry().at("plain").parameters));
    EXPECT_TRUE(e.presets.at("paper").values.empty());
    EXPECT_EQ(e.presets.at("paper").size, glm::ivec2(1024, 1024)) << "of no method";
}

TEST(Edits, AnotherMethodTakesOverTheTransport) {
    // As fog, but for its defaults and a least distance.
    auto mist = registry().at("fog");
    mist.id = "mist";
    for (auto& parameter : mist.parameters) {
        if (parameter.key == "max_distance") parameter.default_value = 5.0, parameter.hard = {1, 100};
        if (parameter.key == "density") parameter.default_value = 0.5;
    }
    const Registry both({&registry().at("fog"), &mist});
    Project project = sample_project();
    auto& e = project.experiments[0];
    e.values["falloff"] = std::string("smooth");
    e.presets["paper"].values["max_distance"] = 2.0;
    const auto before = project;
    UndoStack stack;
    EXPECT_TRUE(edits::lost_by_method(project, both, "fog-nave", "mist").empty());
    stack.push(project, edits::set_method(project, both, "fog-nave", "mist"));
    EXPECT_EQ(e.values.at("falloff"), Value{std::string("smooth")});
    EXPECT_EQ(e.values.at("max_distance"), Value{5.0}) << "from one default to the other";
    EXPECT_EQ(e.values.at("density"), Value{0.5});
    EXPECT_EQ(e.presets.at("paper").values, (Settings{{"max_distance", 2.0}}));
    stack.undo(project);
    EXPECT_EQ(project, before);
    e.presets["paper"].values["max_distance"] = 0.5;
    const auto lost = edits::lost_by_method(project, both, "fog-nave", "mist");
    ASSERT_EQ(lost.size(), 1u);
    EXPECT_NE(lost[0].find("max_distance"), std::string::npos) << lost[0];
    edits::set_method(project, both, "fog-nave", "mist")->apply(project);
    EXPECT_EQ(e.presets.at("paper").values.at("max_distance"), Value{5.0});
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

/// An edit that cannot be applied.
class Impossible final : public Edit {
  public:
    Impossible() : Edit("impossible", "") {}
    void apply(Project&) override { throw Error("impossible"); }
    void revert(Project&) override {}
    bool absorb(const Edit&) override { return false; }
    bool changes_nothing() const override { return false; }
};

TEST(Edits, AGroupHappensAsAWholeOrNotAtAll) {
    Project project = sample_project();
    UndoStack stack;
    std::vector<EditPtr> steps;
    steps.push_back(edits::set_notes(project, "changed"));
    steps.push_back(edits::set_seed(project, "fog-nave", 99));
    steps.push_back(std::make_unique<Impossible>());
    EXPECT_THROW(stack.push(project, edits::group("Three", std::move(steps))), Error);
    EXPECT_EQ(project, sample_project());
    EXPECT_FALSE(stack.can_undo());
    EXPECT_TRUE(stack.is_clean());
}

}  // namespace
}  // namespace ir::projects
