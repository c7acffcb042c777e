#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "renderers/core/error.h"
#include "renderers/scene/scene.h"
#include "tests/processor_time.h"

// Every file of the corpus loads or is refused in one line; those that the Khronos validator calls free of
// errors load with its figures.

namespace {

using ir::scene::Scene;
namespace fs = std::filesystem;

struct Outcome {
    bool loaded = false;
    Scene scene;
    std::string refusal;
};

Outcome load(const std::string& file) {
    Outcome outcome;
    try {
        outcome.scene = ir::scene::load_scene(file);
        outcome.loaded = true;
    } catch (const ir::InputError& error) {
        outcome.refusal = error.what();
    }
    return outcome;
}

/// Files without errors whose figures differ from the index, each with the reason.
const std::map<std::string, std::string>& explained() {
    static const std::map<std::string, std::string> files{
        {"corrupt/gltf-validator/base/data/mesh/primitive_no_position.gltf",
         "a primitive without POSITION: the validator counts its normals, but nothing can be drawn"},
    };
    return files;
}

/// Files without errors that are refused for another reason than a required extension.
const std::map<std::string, std::string>& refused_with_reason() {
    static const std::map<std::string, std::string> files{
        {"corrupt/gltf-validator/base/data/asset/min_version_valid.gltf",
         "asset.minVersion asks for glTF 2.1, which must not be read as 2.0"},
    };
    return files;
}

bool names_an_extension(const std::string& refusal, const nlohmann::json& required) {
    for (const auto& name : required)
        if (refusal.find("extensionsRequired: " + name.get<std::string>()) != std::string::npos) return true;
    return false;
}

double peak_memory_mib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

class Corpus : public testing::Test {
  protected:
    void SetUp() override {
        const char* folder = std::getenv("INTERREFLECT_SCENES");
        if (!folder) GTEST_SKIP() << "INTERREFLECT_SCENES is not set; Mutations is the twin that always runs";
        root = folder;
        std::ifstream stream(root / "INDEX.json");
        ASSERT_TRUE(stream) << root / "INDEX.json";
        index = nlohmann::json::parse(stream);
        ASSERT_FALSE(index.empty());
    }

    fs::path root;
    nlohmann::json index;
};

TEST_F(Corpus, EveryFileLoadsOrIsRefusedInOneLine) {
    std::size_t loaded = 0, refused = 0;
    for (const auto& entry : index) {
        const auto file = (root / entry["file"].get<std::string>()).string();
        // A crash ends the process: the last line of the log then names the file.
        std::fprintf(stderr, "%s\n", file.c_str());
        const double start = ir::processor_seconds();
        const auto outcome = load(file);
        EXPECT_LT(ir::processor_seconds() - start, 20) << file;
        ++(outcome.loaded ? loaded : refused);
        if (outcome.loaded) {
            EXPECT_FALSE(outcome.scene.materials.empty()) << file;
            EXPECT_FALSE(outcome.scene.cameras.empty()) << file;
            continue;
        }
        EXPECT_EQ(outcome.refusal.find('\n'), std::string::npos) << outcome.refusal;
        EXPECT_EQ(outcome.refusal.rfind(file + ": ", 0), 0u) << outcome.refusal;
        EXPECT_GT(outcome.refusal.size(), file.size() + 10) << outcome.refusal;
    }
    EXPECT_LT(peak_memory_mib(), 2048);
    std::printf("%zu loaded, %zu refused, peak %.0f MiB\n", loaded, refused, peak_memory_mib());
}

TEST_F(Corpus, FilesWithoutErrorsHaveTheValidatorsFigures) {
    std::size_t compared = 0;
    for (const auto& entry : index) {
        if (entry.value("errors", 1) != 0) continue;
        const auto name = entry["file"].get<std::string>();
        const auto outcome = load((root / name).string());
        if (!outcome.loaded) {
            EXPECT_TRUE(
                refused_with_reason().contains(name) ||
                (entry.contains("required") && names_an_extension(outcome.refusal, entry["required"])))
                << outcome.refusal;
            continue;
        }
        ++compared;
        const bool equal = outcome.scene.primitive_triangles() == entry["triangles"].get<std::size_t>() &&
                           outcome.scene.material_count == entry["materials"].get<std::size_t>();
        EXPECT_NE(equal, explained().contains(name))
            << name << ": " << outcome.scene.primitive_triangles() << " triangles for " << entry["triangles"]
            << ", " << outcome.scene.material_count << " materials for " << entry["materials"];
    }
    EXPECT_GT(compared, 0u);
    std::printf("%zu files compared, %zu differences explained\n", compared, explained().size());
}

}  // namespace
