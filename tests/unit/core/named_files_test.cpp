#include "renderers/core/named_files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "renderers/core/error.h"

namespace ir {
namespace {

namespace fs = std::filesystem;

/// home/scenes/house/a.gltf, with a folder of textures beside the scene's.
class NamedFiles : public ::testing::Test {
  protected:
    NamedFiles() {
        std::string pattern = (fs::temp_directory_path() / "interreflect-named-XXXXXX").string();
        root = mkdtemp(pattern.data());
        for (const char* folder : {"scenes/house/maps", "scenes/textures", ".ssh"})
            fs::create_directories(root / folder);
        scene = root / "scenes/house/a.gltf";
    }
    ~NamedFiles() override { fs::remove_all(root); }

    bool reads_buffer(const fs::path& name) const {
        return may_read(scene, scene.parent_path() / name, NamedFile::buffer);
    }
    bool reads_image(const fs::path& name) const {
        return may_read(scene, scene.parent_path() / name, NamedFile::image);
    }

    fs::path root, scene;
};

TEST_F(NamedFiles, BuffersLieWithTheirScene) {
    EXPECT_TRUE(reads_buffer("a.bin"));
    EXPECT_TRUE(reads_buffer("maps/../a.bin"));
    EXPECT_TRUE(reads_buffer(scene.parent_path() / "a.bin"));
    for (const char* name : {"../a.bin", "../house2/a.bin", "../../.ssh/id", "/etc/passwd",
                             "maps/../../a.bin", "../textures/stone.png"})
        EXPECT_FALSE(reads_buffer(name)) << name;
    EXPECT_TRUE(may_read("a.gltf", "a.bin", NamedFile::buffer));
    EXPECT_FALSE(may_read("a.gltf", "../a.bin", NamedFile::buffer));
    EXPECT_TRUE(reads_buffer("~root/a.bin")) << "a folder of that name, and nobody's home";
    EXPECT_TRUE(reads_buffer("$HOME/a.bin"));
}

TEST_F(NamedFiles, ImagesMayLieBesideTheFolder) {
    for (const char* name :
         {"a.png", "maps/b", "../textures/stone.png", "../textures/STONE.JPG", "../sky.webp"})
        EXPECT_TRUE(reads_image(name)) << name;
    for (const char* name :
         {"../textures/stone", "../../.ssh/id.png", "/etc/passwd", "../../x.png", "/dev/zero", "../a.bin"})
        EXPECT_FALSE(reads_image(name)) << name;
}

TEST_F(NamedFiles, LinksAreWhatTheyLeadTo) {
    fs::create_symlink(root / ".ssh/id", scene.parent_path() / "a.bin");
    fs::create_directory_symlink(root / ".ssh", scene.parent_path() / "deep");
    fs::create_symlink("maps/b.bin", scene.parent_path() / "b.bin");
    EXPECT_FALSE(reads_buffer("deep/id"));
    std::ofstream(root / ".ssh/id") << "secret";
    EXPECT_FALSE(reads_buffer("a.bin"));
    EXPECT_TRUE(reads_buffer("b.bin"));
    fs::create_directory_symlink(scene.parent_path(), root / "shortcut");
    EXPECT_TRUE(may_read(root / "shortcut/a.gltf", root / "shortcut/c.bin", NamedFile::buffer));
}

TEST_F(NamedFiles, LinksOutAreRefusedBeforeAnythingIsWritten) {
    const auto results = root / "results";
    fs::create_directories(results / "k");
    fs::create_symlink("k", results / "same");
    EXPECT_NO_THROW(refuse_links_out(results, Links::all));
    fs::create_directory_symlink(results, root / "elsewhere");
    EXPECT_NO_THROW(refuse_links_out(root / "elsewhere", Links::all)) << "the folder itself may be a link";
    for (const auto& target : {root / ".ssh", root / "not/there/yet", fs::path("../../.ssh")}) {
        const auto link = results / "k" / "link";
        fs::create_symlink(target, link);
        try {
            refuse_links_out(results, Links::all);
            FAIL() << target;
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()).rfind(link.string() + ": is a link", 0), 0u) << error.what();
        }
        fs::remove(link);
    }
    EXPECT_NO_THROW(refuse_links_out(root / "nothing", Links::all));
    std::ofstream(root / "a.txt") << "text";
    fs::create_symlink(root / "a.txt", results / "file");
    EXPECT_NO_THROW(refuse_links_out(results, Links::to_folders));
    EXPECT_THROW(refuse_links_out(results, Links::all), Error);
    fs::create_directory_symlink(root / ".ssh", results / "folder");
    fs::create_symlink("nothing", results / "dangling");
    EXPECT_THROW(refuse_links_out(results, Links::to_folders), Error);
}

TEST_F(NamedFiles, UrisAreDecodedOnce) {
    EXPECT_EQ(path_in_uri(scene, "a%20b.bin"), "a b.bin");
    EXPECT_EQ(path_in_uri(scene, "%2e%2e/x"), "../x");
    EXPECT_EQ(path_in_uri(scene, ""), "");
    EXPECT_EQ(path_in_uri(scene, "a%00b"), "");
    std::ofstream(scene.parent_path() / "50%25.bin") << "literal";
    EXPECT_EQ(path_in_uri(scene, "50%25.bin"), "50%25.bin");
    EXPECT_TRUE(has_scheme("https://a/b"));
    EXPECT_TRUE(has_scheme("file:///etc/passwd"));
    EXPECT_TRUE(has_scheme("data:,x"));
    EXPECT_FALSE(has_scheme("textures/a:b.png"));
}

}  // namespace
}  // namespace ir
