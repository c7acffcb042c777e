#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>

#include "projects/check.h"
#include "projects/document_json.h"
#include "projects/hash.h"
#include "renderers/core/error.h"
#include "tests/fuzz/projects/attempts.h"
#include "tests/processor_time.h"

/// Damaged and hostile projects: each is opened or refused with one line, quickly, and what opens can be
/// checked, hashed and written.
namespace ir::projects {
namespace {

using Random = std::mt19937;

std::size_t pick(Random& random, std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

std::string file_text(const std::string& name) {
    std::ostringstream text;
    text << std::ifstream(std::string(TEST_DATA "/projects/") + name, std::ios::binary).rdbuf();
    return text.str();
}

Json replacement(Random& random) {
    static const std::vector<Json> values{nullptr,
                                          true,
                                          0,
                                          -1,
                                          1.5,
                                          1e308,
                                          -1e308,
                                          5e-324,
                                          18446744073709551615u,
                                          "",
                                          "x",
                                          "../../../etc/passwd",
                                          "builtin:",
                                          "builtin:a@1?&&=",
                                          std::string(5000, 'a'),
                                          "line\nbreak",
                                          Json::array(),
                                          Json::object(),
                                          Json::array({1, 2, 3}),
                                          Json::array({1, "x"}),
                                          Json::object({{"id", "a"}}),
                                          std::string("nul\0inside", 10),
                                          "ü€😀",
                                          "scene",
                                          "fog",
                                          Json::array({Json::array({Json::array()})})};
    return values[pick(random, values.size())];
}

/// Every value of the tree.
void collect(Json& json, std::vector<Json*>& out) {
    out.push_back(&json);
    if (json.is_structured())
        for (auto& child : json) collect(child, out);
}

void mutate_tree(Json& json, Random& random) {
    std::vector<Json*> all;
    collect(json, all);
    Json& victim = *all[pick(random, all.size())];
    const Json other = *all[pick(random, all.size())];
    switch (pick(random, 6)) {
        case 0:
            victim = replacement(random);
            break;
        case 1:
            if (!victim.empty() && victim.is_object())
                victim.erase(std::next(victim.begin(), static_cast<int>(pick(random, victim.size()))));
            break;
        case 2:
            if (victim.is_array()) victim.push_back(victim.empty() ? replacement(random) : Json(victim[0]));
            break;
        case 3:
            if (victim.is_object()) victim["new \n key/~"] = replacement(random);
            break;
        case 4:
            if (other.size() < 30) victim = other;
            break;
        default:
            if (!victim.empty() && victim.is_array()) victim.erase(pick(random, victim.size()));
    }
}

std::string mutate_bytes(std::string text, Random& random) {
    const std::size_t at = pick(random, text.size());
    switch (pick(random, 6)) {
        case 0:
            text[at] = static_cast<char>(pick(random, 256));
            break;
        case 1:
            text.resize(at);
            break;
        case 2:
            text.erase(at, pick(random, 40));
            break;
        case 3:
            text.insert(at, text.substr(pick(random, text.size()), pick(random, 200)));
            break;
        case 4:
            text.insert(at, std::string(pick(random, 3000), "[{\"9-"[pick(random, 5)]));
            break;
        default:
            text.insert(at, "\xff\xfe\x00\x80");
    }
    return text;
}

/// Every second mutation is one of the parsed tree, the others are of bytes.
std::string mutated(const std::string& text, int number, Random& random) {
    if (number % 2 != 0) return mutate_bytes(text, random);
    Json json = parse_json(text, "seed");
    for (std::size_t n = 1 + pick(random, 3); n > 0; --n) mutate_tree(json, random);
    return json.dump(pick(random, 2) ? 2 : -1);
}

struct Outcomes {
    int opened = 0, refused = 0;
};

/// `opens` says whether a mutation was opened; it may refuse but not crash, and not take long.
Outcomes mutate(const std::vector<std::string>& seeds, int count, unsigned seed,
                const std::function<bool(const std::string&)>& opens) {
    Random random(seed);
    Outcomes outcomes;
    double longest = 0;
    for (int i = 0; i < count; ++i) {
        const auto text = mutated(seeds[pick(random, seeds.size())], i, random);
        const double start = processor_seconds();
        try {
            (opens(text) ? outcomes.opened : outcomes.refused)++;
        } catch (const std::exception& error) {
            ADD_FAILURE() << "mutation " << i << ": " << error.what() << "\n" << text;
            return outcomes;
        }
        longest = std::max(longest, processor_seconds() - start);
    }
    EXPECT_LT(longest, 5);  // generous: sanitizers
    return outcomes;
}

/// Both outcomes are frequent, or the mutations would test nothing.
void expect_both(const Outcomes& outcomes) {
    EXPECT_GT(outcomes.opened, (outcomes.opened + outcomes.refused) / 20);
    EXPECT_GT(outcomes.refused, (outcomes.opened + outcomes.refused) / 20);
}

// 10,000 mutations in all: of the project file and of what stands beside it.

TEST(ProjectFuzz, SixThousandMutationsOpenOrAreRefusedWithOneLine) {
    auto changed = parse_json(file_text("schema-6.json"), "seed");
    changed["shaders_allowed"] = false;
    changed["experiments"][0]["shaders"] = {
        {"lib/random.glsl", {"@@ -1,2 +1,2 @@", " a", "-b", "+c"}},
        {"methods/fog/march.comp", {"@@ -0,0 +1,1 @@", "+a", "\\ No newline at end of file"}}};
    expect_both(mutate({pretty_json(changed), file_text("schema-6.json"), file_text("schema-4.json"),
                        file_text("schema-3.json"), file_text("schema-2.json"), file_text("schema-1.json")},
                       6000, 20240501, fuzz::opens_project));
}

TEST(AutosaveFuzz, FifteenHundredMutationsAreOfferedOrIgnored) {
    const auto project = read_project(file_text("schema-6.json"), "seed", fuzz::registry()).project;
    const Json autosave = {{"base_hash", hash_bytes("base")},
                           {"contains", {"project.json.recovery-1", "project.json.recovery-2"}},
                           {"project", to_json(project)}};
    expect_both(mutate({pretty_json(autosave)}, 1500, 20240502, fuzz::offers_autosave));
}

/// What libFuzzer begins with.
TEST(HunksFuzz, TwoThousandMutationsAreAppliedOrRefusedWithOneLine) {
    std::vector<std::string> seeds;
    for (const auto* name : {"git", "moved", "ends", "added"}) {
        std::ostringstream text;
        text << std::ifstream(std::string(SOURCE_ROOT "/tests/fuzz/corpus/hunks/") + name, std::ios::binary)
                    .rdbuf();
        seeds.push_back(text.str());
    }
    Random random(20261128);
    Outcomes outcomes;
    for (int i = 0; i < 2000; ++i) {
        const auto text = mutate_bytes(seeds[pick(random, seeds.size())], random);
        (fuzz::changes_shaders(text) ? outcomes.opened : outcomes.refused)++;
    }
    expect_both(outcomes);
}

TEST(ResultsFuzz, FifteenHundredMutationsAreReadOrRefusedWithOneLine) {
    Json index = {{"schema", 1}, {"entries", Json::array()}};
    for (const char* key : {"0011aabb", "2233ccdd"})
        index["entries"].push_back(
            {{"key", key},
             {"experiment", "fog-nave"},
             {"files",
              {{{"role", "main"}, {"path", std::string(key) + "/main.exr"}, {"content_hash", "ff"}},
               {{"role", "statistics"}, {"path", std::string(key) + "/statistics.json"}}}},
             {"provenance",
              {{"build", "0.1"}, {"driver", "d"}, {"backend", "egl"}, {"date", "2024-05-01T12:00:00Z"}}},
             {"inputs", {{"seed", 7}, {"size", {640, 480}}, {"values", {{"samples", 16}}}}}});
    expect_both(mutate({pretty_json(index)}, 1500, 20240503, fuzz::reads_results));
}

TEST(SessionFuzz, ThousandMutationsGiveAnObject) {
    const Json session = {{"layout", "compare"},
                          {"zoom", 2.5},
                          {"experiment", "fog-nave"},
                          {"pins", {{1, 2}, {3, 4}}},
                          {"views", {{{"id", "a"}, {"state", "AAEC"}}, {{"id", "b"}}}}};
    expect_both(mutate({pretty_json(session)}, 1000, 20240504, fuzz::reads_session));
}

TEST(ProjectFuzz, HostileShapesAreRefusedQuickly) {
    std::string many_keys = "{\"schema\": 2", deep, wide = "{\"schema\": 2, \"scenes\": [", objects = wide;
    for (int i = 0; i < 400000; ++i) many_keys += ",\"k" + std::to_string(i) + "\":0";
    for (int i = 0; i < 1000000; ++i) deep += "{\"a\":[";
    for (int i = 0; i < 1000000; ++i) wide += "0,";
    for (int i = 0; i < 1000000; ++i) objects += "{},";
    const std::vector<std::string> all{many_keys + "}", deep, wide + "0]}", objects + "{}]}",
                                       std::string(20u << 20, ' ')};
    for (const auto& text : all) {
        const double start = processor_seconds();
        EXPECT_THROW(read_project(text, "hostile.json", fuzz::registry()), InputError);
        EXPECT_LT(processor_seconds() - start, 10);
    }
}

/// Lists of objects or names, wherever they stand.
void collect_lists(const Json& json, const Json::json_pointer& at, std::vector<Json::json_pointer>& out) {
    if (json.is_array() && !json.empty() && (json[0].is_object() || json[0].is_string())) out.push_back(at);
    if (json.is_structured())
        for (const auto& [key, child] : json.items()) collect_lists(child, at / key, out);
}

/// The first item of a list of objects or names, again and again until there is a megabyte, each with an id
/// of its own.
Json longer(const Json& list) {
    const Json first = list[0];
    const auto count = (1u << 20) / (first.dump().size() + 9);
    Json items = Json::array();
    for (std::size_t i = 0; i < count; ++i) {
        Json item = first;
        const auto number = std::to_string(i);
        if (item.is_string()) item = item.get<std::string>() + number;
        if (item.contains("id")) item["id"] = item["id"].get<std::string>() + number;
        if (item.contains("time")) item["time"] = i;
        items.push_back(std::move(item));
    }
    return items;
}

/// A megabyte in any list of a project takes at most 2 s of a processor, and ten times that with sanitizers.
TEST(ProjectFuzz, LongListsAreReadQuickly) {
#ifdef INTERREFLECT_SANITIZED
    constexpr double most_seconds = 20;
#else
    constexpr double most_seconds = 2;
#endif
    const Json seed = parse_json(file_text("schema-6.json"), "seed");
    std::vector<Json::json_pointer> lists;
    collect_lists(seed, Json::json_pointer(), lists);
    EXPECT_GT(lists.size(), 10u);
    for (const auto& at : lists) {
        Json document = seed;
        document[at] = longer(seed[at]);
        const auto text = document.dump();
        const double start = processor_seconds();
        try {
            check(read_project(text, "long.json", fuzz::registry()), "/nonexistent", fuzz::registry());
        } catch (const InputError& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
        EXPECT_LT(processor_seconds() - start, most_seconds) << at;
    }
}

/// Together these sweeps have 9 million variations, of 60,000 values.
TEST(ProjectFuzz, ManySweepsAreCheckedQuickly) {
    Json values = Json::array(), sweeps = Json::array();
    for (int i = 1; i <= 300; ++i) values.push_back(i);
    for (int i = 0; i < 100; ++i)
        sweeps.push_back(
            {{"id", "s" + std::to_string(i)},
             {"experiment", "a"},
             {"axes", {{{"key", "samples"}, {"values", values}}, {{"key", "seed"}, {"values", values}}}}});
    const Json document{
        {"schema", schema_version}, {"experiments", {{{"id", "a"}, {"method", "fog"}}}}, {"sweeps", sweeps}};
    const auto opened = read_project(document.dump(), "hostile.json", fuzz::registry());
    ASSERT_EQ(opened.project.sweeps.size(), 100u);
    const double start = processor_seconds();
    for (const auto& message : check(opened, "/nonexistent", fuzz::registry()))
        EXPECT_EQ(message.text.find("/axes"), std::string::npos) << message.text;
    EXPECT_LT(processor_seconds() - start, 10);
}

TEST(LightFuzz, MutatedSpecsParseOrAreRefusedWithOneLine) {
    const std::vector<std::string> seeds{
        "point:position=0,2,0;flux=40;color=1,0.5,0.25",
        "spot:position=0,3,0;target=0,0,0;intensity=10;outer=30;inner=20",
        "directional:direction=0,-1,0.2;irradiance=3",
        "rect:position=0,3,0;target=0,0,0;size=1,2;radiance=5",
    };
    Random random(7);
    int parsed = 0, refused = 0;
    for (int i = 0; i < 5000; ++i) {
        auto text = seeds[pick(random, seeds.size())];
        static const std::string alphabet = ":;=,.-+e0123456789xinfan \n\xff";
        for (std::size_t n = 1 + pick(random, 3); n > 0; --n) {
            const auto at = pick(random, text.size());
            if (pick(random, 2))
                text[at] = alphabet[pick(random, alphabet.size())];
            else
                text.erase(at, 1 + pick(random, 3));
        }
        ++(fuzz::reads_light(text) ? parsed : refused);
    }
    EXPECT_GT(parsed, 100);
    EXPECT_GT(refused, 100);
}

/// What libFuzzer begins with, and what it found before.
TEST(Seeds, AreOpenedOrRefusedInOneLine) {
    const std::vector<std::pair<std::string, bool (*)(const std::string&)>> targets{
        {"project", fuzz::opens_project},
        {"autosave", fuzz::offers_autosave},
        {"results", fuzz::reads_results},
        {"session", fuzz::reads_session},
        {"light", fuzz::reads_light}};
    int seeds = 0;
    for (const auto& [target, attempt] : targets) {
        const auto folder = std::filesystem::path(SOURCE_ROOT "/tests/fuzz/corpus") / target;
        if (!std::filesystem::exists(folder)) continue;
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            std::ostringstream text;
            text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
            EXPECT_NO_THROW(attempt(text.str())) << entry.path();
            ++seeds;
        }
    }
    EXPECT_GT(seeds, 5);
}

}  // namespace
}  // namespace ir::projects
