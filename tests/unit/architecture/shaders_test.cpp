#include <gtest/gtest.h>

#include "tests/unit/architecture/source_tree.h"

namespace ir::test {
namespace {

const std::vector<std::string> shader_endings{".vert", ".tesc", ".tese", ".geom", ".frag", ".comp", ".glsl"};

TEST(Shaders, IncludesAreFoundAndGoOnlyDownwards) {
    const std::filesystem::path root = SOURCE_ROOT;
    const auto layer = [](const std::string& path) {  // shaders/methods/ID, shaders/passes, shaders/lib
        if (!path.starts_with("shaders/methods/")) return path.substr(0, path.find('/', 8));
        return path.substr(0, path.find('/', 16));
    };
    const auto files = source_files({"shaders"}, shader_endings);
    EXPECT_GT(files.size(), 10u);
    for (const auto& file : files)
        for (const auto& include : includes_of(file.text).own) {
            auto found = std::filesystem::path(file.path).parent_path() / include;
            if (!std::filesystem::exists(root / found)) found = std::filesystem::path("shaders") / include;
            EXPECT_TRUE(std::filesystem::exists(root / found)) << file.path << " includes " << include;
            EXPECT_TRUE(include.ends_with(".glsl")) << file.path << " includes an entry point, " << include;
            const auto from = layer(file.path), to = layer(found.lexically_normal().generic_string());
            EXPECT_TRUE(from == to || to == "shaders/lib" ||
                        (to == "shaders/passes" && from.starts_with("shaders/methods/")))
                << file.path << " includes " << include;
        }
}

TEST(Shaders, FoldersMirrorRenderers) {
    const auto methods = folders_in("renderers/methods");
    for (const auto& id : folders_in("shaders/methods"))
        EXPECT_TRUE(methods.count(id)) << "shaders/methods/" << id << " has no renderers/methods/" << id;
    const auto passes = folders_in("renderers/passes");
    for (const auto& subject : folders_in("shaders/passes"))
        EXPECT_TRUE(passes.count(subject))
            << "shaders/passes/" << subject << " has no renderers/passes/" << subject;
}

/// By its path anywhere, or by its file's name in the folder of the same subject.
bool names(const SourceFile& code, const std::string& shader) {
    const auto subject = "renderers/" + shader.substr(0, shader.find('/', shader.find('/') + 1) + 1);
    const auto file = shader.substr(shader.rfind('/') + 1);
    return code.text.find('"' + shader + '"') != std::string::npos ||
           (code.path.starts_with(subject) && (code.text.find('"' + file + '"') != std::string::npos ||
                                               code.text.find('/' + file + '"') != std::string::npos));
}

TEST(Shaders, BlocksSamplersAndImagesHaveNoNumbers) {
    for (const auto& file : source_files({"shaders", "tests/data/shaders"}, shader_endings))
        EXPECT_FALSE(std::regex_search(without_comments(file.text), std::regex(R"(\bbinding\s*=)")))
            << file.path << " has a binding; passes bind by name";
}

TEST(Shaders, EveryEntryPointIsUsed) {
    const auto code = source_files({"renderers", "app"}, {".cpp", ".h"});
    for (const auto& file : source_files({"shaders"}, shader_endings)) {
        if (file.path.ends_with(".glsl")) continue;
        const auto shader = file.path.substr(8);
        EXPECT_TRUE(
            std::any_of(code.begin(), code.end(), [&](const auto& each) { return names(each, shader); }))
            << file.path << " is named nowhere";
    }
}

TEST(Shaders, EveryMethodHasItsFile) {
    for (const auto& id : folders_in("renderers/methods"))
        EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(SOURCE_ROOT) / "renderers/methods" / id /
                                            "method.cpp"))
            << id;
}

}  // namespace
}  // namespace ir::test
