#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>

#include "projects/autosave.h"
#include "projects/check.h"
#include "projects/document_json.h"
#include "projects/edits.h"
#include "projects/hash.h"
#include "projects/light_spec.h"
#include "projects/results.h"
#include "projects/store.h"
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
Outcomes fuzz(const std::vector<std::string>& seeds, int count, unsigned seed,
              const std::function<bool(const std::string&)>& opens) {
    Random random(seed);
    Outcomes outcomes;
    std::chrono::duration<double> longest{0};
    for (int i = 0; i < count; ++i) {
        const auto text = mutated(seeds[pick(random, seeds.size())], i, random);
        const auto start = std::chrono::steady_clock::now();
        (opens(text) ? outcomes.opened : outcomes.refused)++;
        longest = std::max(longest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start));
        if (::testing::Test::HasFailure()) {
            ADD_FAILURE() << "mutation " << i << ":\n" << text;
            return outcomes;
        }
    }
    EXPECT_LT(longest.count(), 5);  // generous: sanitizers and busy machines
    return outcomes;
}

/// Both outcomes are frequent, or the mutations would test nothing.
void expect_both(const Outcomes& outcomes) {
    EXPECT_GT(outcomes.opened, (outcomes.opened + outcomes.refused) / 20);
    EXPECT_GT(outcomes.refused, (outcomes.opened + outcomes.refused) / 20);
}

void expect_one_line(const std::string& line, const std::string& file) {
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_EQ(line.rfind(file, 0), 0u) << line;
    EXPECT_LT(line.size(), 1000u) << line;
}

/// One file in memory; everything else is absent.
class OneFile final : public FileSystem {
  public:
    OneFile(std::filesystem::path name, std::string text) : name_(std::move(name)), text_(std::move(text)) {}
    bool exists(const std::filesystem::path& path) override { return path == name_; }
    std::string read(const std::filesystem::path& file, std::size_t) override {
        if (file != name_) throw InputError(file.string(), "", "cannot be opened");
        return text_;
    }
    std::int64_t modified(const std::filesystem::path&) override { return 0; }
    std::vector<std::filesystem::path> list(const std::filesystem::path&) override { return {}; }
    void write(const std::filesystem::path&, const std::filesystem::path&, const Fill&) override {
        throw_written();
    }
    void sync_directory(const std::filesystem::path&) override { throw_written(); }
    void rename(const std::filesystem::path&, const std::filesystem::path&) override { throw_written(); }
    void remove(const std::filesystem::path&) override { throw_written(); }
    void remove_all(const std::filesystem::path&) override { throw_written(); }
    void create_directories(const std::filesystem::path&) override { throw_written(); }
    void pour(const std::filesystem::path&, std::ostream&) override { throw_written(); }

  private:
    [[noreturn]] static void throw_written() { throw std::logic_error("reading must not write"); }
    std::filesystem::path name_;
    std::string text_;
};

// 10,000 mutations in all: of the project file and of what stands beside it.

TEST(ProjectFuzz, SixThousandMutationsOpenOrAreRefusedWithOneLine) {
    expect_both(fuzz({file_text("schema-6.json"), file_text("schema-4.json"), file_text("schema-3.json"),
                      file_text("schema-2.json"), file_text("schema-1.json")},
                     6000, 20240501, survives));
}

TEST(AutosaveFuzz, FifteenHundredMutationsAreOfferedOrIgnored) {
    const auto project = read_project(file_text("schema-6.json"), "seed", registry()).project;
    const Json autosave = {{"base_hash", hash_bytes("base")},
                           {"contains", {"project.json.recovery-1", "project.json.recovery-2"}},
                           {"project", to_json(project)}};
    expect_both(fuzz({pretty_json(autosave)}, 1500, 20240502, [](const std::string& text) {
        OneFile files(std::filesystem::path("p") / autosave_file_name, text);
        const auto recovery = find_recovery("p", registry(), files);
        if (!recovery) return false;
        EXPECT_EQ(recovery->summary.find('\n'), std::string::npos);
        const auto written = write_project(recovery->project);
        EXPECT_EQ(write_project(read_project(written, "again.json", registry()).project), written);
        return true;
    }));
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
    const auto name = std::filesystem::path("p") / "results" / "index.json";
    expect_both(fuzz({pretty_json(index)}, 1500, 20240503, [&](const std::string& text) {
        OneFile files(name, text);
        try {
            const auto read = ResultIndex::load("p", files);
            for (const auto& message : check_results(read, "/nonexistent"))
                EXPECT_EQ(message.text.find('\n'), std::string::npos) << message.text;
            for (const auto& entry : read.entries())
                for (const auto& line : differences(entry.inputs, {{"seed", 8}}))
                    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
            ResultIndex again;
            for (const auto& entry : read.entries()) again.put(entry);
            return true;
        } catch (const InputError& error) {
            expect_one_line(error.what(), name.string());
            return false;
        }
    }));
}

TEST(SessionFuzz, ThousandMutationsGiveAnObject) {
    const Json session = {{"layout", "compare"},
                          {"zoom", 2.5},
                          {"experiment", "fog-nave"},
                          {"pins", {{1, 2}, {3, 4}}},
                          {"views", {{{"id", "a"}, {"state", "AAEC"}}, {{"id", "b"}}}}};
    expect_both(fuzz({pretty_json(session)}, 1000, 20240504, [](const std::string& text) {
        OneFile files(std::filesystem::path("p") / "session.json", text);
        const auto read = load_session("p", files);
        EXPECT_TRUE(read.is_object());
        return !read.empty();
    }));
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
