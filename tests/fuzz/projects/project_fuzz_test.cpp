#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <random>
#include <sstream>

#include "projects/check.h"
#include "projects/document_json.h"
#include "projects/edits.h"
#include "projects/light_spec.h"
#include "projects/results.h"
#include "projects/sweep.h"
#include "renderers/core/error.h"

/// Damaged and hostile projects: each is opened or refused with one line, quickly, and what opens can be
/// checked, hashed and written.
namespace ir::projects {
namespace {

using Random = std::mt19937;

std::size_t pick(Random& random, std::size_t count) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

const Registry& registry() {
    static const MethodDescription fog = [] {
        MethodDescription method;
        method.id = "fog";
        method.version = 3;
        const auto number = [](const char* key, ParameterType type, Value value, Range hard) {
            ParameterDescription parameter;
            parameter.key = key;
            parameter.type = type;
            parameter.default_value = std::move(value);
            parameter.hard = hard;
            return parameter;
        };
        method.parameters = {number("samples", ParameterType::integer, std::int64_t{16}, {1, 4096}),
                             number("density", ParameterType::number, 0.25, {0, 100}),
                             number("max_distance", ParameterType::number, 0.0, {0, 1e9}),
                             number("jitter", ParameterType::toggle, true, {})};
        return method;
    }();
    static const Registry all({&fog});
    return all;
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

/// Runs everything that a window or command does first. Returns whether the project opened.
bool survives(const std::string& text) {
    try {
        const auto read = read_project(text, "fuzz.json", registry());
        const auto written = write_project(read.project);
        const auto again = read_project(written, "again.json", registry());
        EXPECT_EQ(write_project(again.project), written);
        for (const auto& message : check(read, "/nonexistent", registry()))
            EXPECT_EQ(message.text.find('\n'), std::string::npos) << message.text;
        for (const auto& experiment : read.project.experiments) {
            result_key(read.project, experiment, registry());
            why_not_runnable(read.project, experiment, registry(), "/nonexistent");
        }
        for (const auto& sweep : read.project.sweeps) {
            try {
                sweep_points(read.project, sweep, registry());
            } catch (const UsageError& error) {
                EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
            }
        }
        return true;
    } catch (const InputError& error) {
        const std::string line = error.what();
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
        EXPECT_EQ(line.rfind("fuzz.json: ", 0), 0u) << line;  // never refuses what it wrote itself
        EXPECT_LT(line.size(), 1000u) << line;
        return false;
    }
}

TEST(ProjectFuzz, FiveThousandMutationsOpenOrAreRefusedWithOneLine) {
    const std::vector<std::string> seeds{file_text("schema-2.json"), file_text("schema-1.json")};
    Random random(20240501);
    int opened = 0, refused = 0;
    std::chrono::duration<double> longest{0};
    for (int i = 0; i < 5000; ++i) {
        std::string text = seeds[pick(random, seeds.size())];
        if (i % 2 == 0) {
            Json json = parse_json(text, "seed");
            for (std::size_t n = 1 + pick(random, 3); n > 0; --n) mutate_tree(json, random);
            text = json.dump(pick(random, 2) ? 2 : -1);
        } else {
            text = mutate_bytes(text, random);
        }
        const auto start = std::chrono::steady_clock::now();
        (survives(text) ? opened : refused)++;
        longest = std::max(longest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start));
        if (HasFailure()) FAIL() << "mutation " << i << ":\n" << text;
    }
    // Both outcomes are frequent, or the mutations would test nothing.
    EXPECT_GT(opened, 500);
    EXPECT_GT(refused, 500);
    EXPECT_LT(longest.count(), 5);  // generous: sanitizers and busy machines
    RecordProperty("opened", opened);
    RecordProperty("refused", refused);
}

TEST(ProjectFuzz, HostileShapesAreRefusedQuickly) {
    std::string many_keys = "{\"schema\": 2", deep, wide = "{\"schema\": 2, \"scenes\": [";
    for (int i = 0; i < 400000; ++i) many_keys += ",\"k" + std::to_string(i) + "\":0";
    for (int i = 0; i < 1000000; ++i) deep += "{\"a\":[";
    for (int i = 0; i < 1000000; ++i) wide += "0,";
    const std::vector<std::string> all{many_keys + "}", deep, wide + "0]}", std::string(20u << 20, ' ')};
    for (const auto& text : all) {
        const auto start = std::chrono::steady_clock::now();
        EXPECT_THROW(read_project(text, "hostile.json", registry()), InputError);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        EXPECT_LT(took.count(), 10);
    }
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
        try {
            const auto light = parse_light(text);
            EXPECT_EQ(parse_light(to_string(light)), light);
            ++parsed;
        } catch (const UsageError& error) {
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
            ++refused;
        }
    }
    EXPECT_GT(parsed, 100);
    EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace ir::projects
