#include <gtest/gtest.h>

#include "tests/unit/architecture/source_tree.h"

namespace ir::test {
namespace {

/// The layer a path belongs to: "app", "renderers/gl", "renderers/methods/ldm-ao", …
std::string layer_of(const std::string& path) {
    const auto part = [&](int count) {
        std::size_t end = 0;
        for (int i = 0; i < count && end != std::string::npos; ++i) end = path.find('/', end + (i > 0));
        return path.substr(0, end);
    };
    if (!path.starts_with("renderers/")) return part(1);
    if (!path.starts_with("renderers/methods/")) return part(2);
    return std::count(path.begin(), path.end(), '/') > 2 ? part(3) : part(2);
}

/// A header of records stands for the shader that it is made from (renderers/gl/records.py), and belongs to
/// the layer that its folder mirrors; those of lib/ belong to the passes, but for what the graph itself
/// reads.
std::string source_of(const std::string& include) {
    return include.starts_with("shaders/") && include.ends_with(".h") ? include.substr(0, include.size() - 2)
                                                                      : include;
}
std::string included_layer(const std::string& include) {
    if (include == "shaders/lib/debug.glsl.h") return "renderers/graph";
    if (include.starts_with("shaders/lib/")) return "renderers/passes";
    if (include.starts_with("shaders/")) return layer_of("renderers/" + include.substr(8));
    return layer_of(include);
}

/// Whether a file of layer `from` may include one of layer `to`.
bool may_include(const std::string& from, const std::string& to) {
    static const std::map<std::string, std::set<std::string>> allowed{
        {"widgets", {"projects", "renderers/core", "renderers/image", "renderers/plot"}},
        {"projects", {"renderers/core"}},
        {"renderers/passes",
         {"renderers/graph", "renderers/gl", "renderers/scene", "renderers/image", "renderers/core"}},
        {"renderers/graph", {"renderers/gl", "renderers/scene", "renderers/image", "renderers/core"}},
        {"renderers/gl", {"renderers/core"}},
        {"renderers/scene", {"renderers/image", "renderers/core"}},
        {"renderers/image", {"renderers/core"}},
        {"renderers/plot", {"renderers/core", "renderers/image"}},
        {"renderers/core", {}}};
    if (from == to) return true;
    if (from == "app") return !to.starts_with("renderers/methods/") && to != "tests";
    if (from == "renderers/methods") return to == "renderers/graph";  // the table of all methods
    if (from.starts_with("renderers/methods/"))
        return to == "renderers/passes" || allowed.at("renderers/passes").count(to) > 0;
    const auto found = allowed.find(from);
    return found != allowed.end() && found->second.count(to) > 0;
}

TEST(Layers, KnowUpFromDown) {
    EXPECT_TRUE(may_include("app", "widgets"));
    EXPECT_TRUE(may_include("renderers/methods/a", "renderers/passes"));
    EXPECT_FALSE(may_include("renderers/methods/a", "renderers/methods/b"));
    EXPECT_FALSE(may_include("renderers/core", "renderers/gl"));
    EXPECT_FALSE(may_include("renderers/gl", "renderers/scene"));
    EXPECT_FALSE(may_include("widgets", "renderers/graph"));
    EXPECT_FALSE(may_include("projects", "widgets"));
    EXPECT_EQ(layer_of("renderers/methods/ldm-ao/a/b.h"), "renderers/methods/ldm-ao");
    EXPECT_EQ(layer_of("renderers/methods/all_methods.h"), "renderers/methods");
    EXPECT_EQ(layer_of("renderers/gl/device.h"), "renderers/gl");
    EXPECT_EQ(layer_of("app/cli/main.cpp"), "app");
    EXPECT_EQ(includes_of("#include \"a.h\"\n  # include <b>\n// #include \"c.h\"\n").own.size(), 1u);
}

TEST(Layers, IncludesGoOnlyDownwards) {
    std::size_t seen = 0;
    for (const auto& file : source_files(code_folders, {".h", ".cpp", ".in"}))
        for (const auto& include : includes_of(file.text).own) {
            ++seen;
            EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(SOURCE_ROOT) / source_of(include)))
                << file.path << " includes " << include << ", which is no path from the root";
            EXPECT_TRUE(may_include(layer_of(file.path), included_layer(include)))
                << file.path << " includes " << include;
        }
    EXPECT_GT(seen, 100u);
}

TEST(Layers, RenderersAndProjectsKnowNoQt) {
    const std::regex qt(R"(^Q[A-Za-z]\w*(/|$)|^q[a-z]+\.h$)");
    EXPECT_TRUE(std::regex_search("QtCore/QString", qt) && std::regex_search("QString", qt));
    for (const auto& file : source_files({"renderers", "projects"}, {".h", ".cpp", ".in"}))
        for (const auto& include : includes_of(file.text).system)
            EXPECT_FALSE(std::regex_search(include, qt)) << file.path << " includes <" << include << ">";
}

TEST(Layers, WindowsAndCommandsNameNoMethod) {
    const auto ids = folders_in("renderers/methods");
    EXPECT_GE(ids.size(), 2u);
    auto files = source_files({"app", "widgets"}, {".h", ".cpp"});
    EXPECT_GT(files.size(), 10u);
    for (auto& file : files) file.text = without_comments(file.text);
    for (const auto& id : ids) {
        auto name = id;
        std::replace(name.begin(), name.end(), '-', '_');
        // Its namespace and its folder; then the id itself, which may be an English word where it has no
        // hyphen: that counts beside the word "method".
        std::string pattern = "methods::" + name + "\\b|methods/" + id + "\\b";
        if (id == name)
            pattern += "|[Mm]ethod[^\\n;]*\"" + id + "\"";
        else
            pattern += "|\\b" + name + "\\b|\\b" + id + "\\b";
        const std::regex names_it(pattern);
        for (const auto& file : files) {
            if (file.text.find(id) == std::string::npos && file.text.find(name) == std::string::npos)
                continue;  // faster than the expression
            std::smatch match;
            EXPECT_FALSE(std::regex_search(file.text, match, names_it))
                << file.path << " names " << match.str();
        }
    }
}

/// Fails for a header that reaches itself through includes.
class Cycles {
  public:
    explicit Cycles(const std::vector<SourceFile>& headers) {
        for (const auto& header : headers) includes_[header.path] = includes_of(header.text).own;
    }
    std::string find() {
        for (const auto& [path, includes] : includes_)
            if (visit(path)) return trail_;
        return {};
    }

  private:
    bool visit(const std::string& path) {
        auto& state = states_[path];
        if (state == 2) return false;
        if (state == 1) {
            trail_ = path;
            return true;
        }
        state = 1;
        for (const auto& next : includes_[path])
            if (visit(next)) {
                trail_ = path + " → " + trail_;
                return true;
            }
        states_[path] = 2;
        return false;
    }
    std::map<std::string, std::vector<std::string>> includes_;
    std::map<std::string, int> states_;
    std::string trail_;
};

TEST(Layers, HeadersIncludeEachOtherInNoCircle) {
    EXPECT_EQ(Cycles(source_files(code_folders, {".h"})).find(), "");
    EXPECT_NE(Cycles({{"a.h", "#include \"b.h\"\n"}, {"b.h", "#include \"a.h\"\n"}}).find(), "");
}

TEST(Layers, WidgetsKnowTheDocumentInOneFolder) {
    std::size_t inside = 0;
    for (const auto& file : source_files({"widgets"}, {".h", ".cpp"}))
        for (const auto& include : includes_of(file.text).own) {
            if (!include.starts_with("projects/")) continue;
            ++inside;
            EXPECT_TRUE(file.path.starts_with("widgets/document/")) << file.path << " includes " << include;
        }
    EXPECT_GT(inside, 5u);
}

TEST(Layers, FoldersOfWidgetsUseEachOtherInNoCircle) {
    const auto folder_of = [](const std::string& path) { return path.substr(0, path.rfind('/')); };
    std::map<std::string, SourceFile> folders;
    for (const auto& file : source_files({"widgets"}, {".h", ".cpp"}))
        for (const auto& include : includes_of(file.text).own) {
            const std::string from = folder_of(file.path), to = folder_of(include);
            if (from == to) continue;
            folders[from].path = from;
            folders[from].text += "#include \"" + to + "\"\n";
        }
    EXPECT_GT(folders.size(), 5u);
    std::vector<SourceFile> all;
    for (const auto& [path, folder] : folders) all.push_back(folder);
    EXPECT_EQ(Cycles(all).find(), "");
}

TEST(Layers, EveryHeaderIsReadOnce) {
    for (const auto& file : source_files(code_folders, {".h"}))
        EXPECT_NE(file.text.find("#pragma once\n"), std::string::npos) << file.path;
}

TEST(Layers, CodeStandsInItsFolders) {
    const std::set<std::string> known{"core", "gl", "graph", "scene", "image", "plot", "passes", "methods"};
    EXPECT_EQ(folders_in("renderers"), known);
    for (const auto& entry : std::filesystem::directory_iterator(SOURCE_ROOT)) {
        const auto ending = entry.path().extension();
        EXPECT_FALSE(ending == ".cpp" || ending == ".h") << entry.path();
    }
}

/// Each asserts something, or calls what does so and says it by its name.
TEST(Layers, TestsCanFail) {
    static const std::regex head(R"(\n(?:TEST|TEST_F|TEST_P|TYPED_TEST)\((\w+), (\w+)\))");
    static const std::regex assertion(R"(\b(EXPECT_|ASSERT_|FAIL\(|ADD_FAILURE|expect_|assert_|expect\())");
    int tests = 0;
    for (const auto& file : source_files({"tests"}, {".cpp"})) {
        const auto text = without_comments(file.text);
        for (std::sregex_iterator at(text.begin(), text.end(), head), none; at != none; ++at, ++tests) {
            const auto begin = static_cast<std::size_t>(at->position());
            const auto body = text.substr(begin, text.find("\n}\n\n", begin) - begin);
            EXPECT_TRUE(std::regex_search(body, assertion)) << file.path << " asserts nothing:" << at->str();
        }
    }
    EXPECT_GT(tests, 2000);
}

}  // namespace
}  // namespace ir::test
