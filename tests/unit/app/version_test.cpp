// Every build looks up the commit of its sources; pictures, statistics and --version tell it.
#include "app/engine/version.h"

#include "renderers/image/exr.h"
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

class Version : public CommandTest {
  protected:
    /// What a build in the folder `tree` would say.
    std::string commit() const {
        const auto source = folder_ / "commit.cpp";
        shell("cmake -D SOURCE=" + file("tree") + " -D FILE=" + source.string() +
              " -P " SOURCE_ROOT "/app/engine/commit.cmake");
        const auto text = read(source);
        const auto begin = text.find("return \"") + 8;
        return text.substr(begin, text.find('"', begin) - begin);
    }
    void git(const std::string& arguments) const {
        shell("git -C " + file("tree") + " -c user.name=a -c user.email=a@b " + arguments);
    }
    void shell(const std::string& command) const {
        EXPECT_EQ(std::system((command + " >" + file("told") + " 2>&1").c_str()), 0) << read(file("told"));
    }
};

TEST_F(Version, TellsTheCommitAndWhetherTheTreeDiffers) {
    fs::create_directories(folder_ / "tree");
    EXPECT_EQ(commit(), "unknown") << "outside git";
    std::ofstream(folder_ / "tree" / "a") << "1";
    git("init");
    git("add a");
    git("commit -m one");
    git("tag v1");
    const auto clean = commit();
    EXPECT_EQ(clean.size(), 12u) << clean;
    EXPECT_EQ(clean.find_first_not_of("0123456789abcdef"), std::string::npos) << clean;
    const auto written = fs::last_write_time(folder_ / "commit.cpp");
    EXPECT_EQ(commit(), clean);
    EXPECT_EQ(fs::last_write_time(folder_ / "commit.cpp"), written) << "nothing is to be compiled again";
    std::ofstream(folder_ / "tree" / "a") << "23";
    EXPECT_EQ(commit(), clean + "-dirty");
    git("commit -a -m two");
    EXPECT_EQ(commit().size(), 12u);
    EXPECT_NE(commit(), clean);
}

TEST_F(Version, IsInPicturesAndStatistics) {
    const auto commit = engine::commit();
    ASSERT_FALSE(commit.empty());
    EXPECT_EQ(output("--version"), "interreflect-cli " + engine::version() + ", commit " + commit + "\n");
    const auto statistics =
        Json::parse(output("render --scene builtin:cornell --method view-normals --size 8x8 --quiet --json "
                           "--out " +
                           file("a.exr")));
    EXPECT_EQ(statistics["commit"], commit);
    ImageAttributes attributes;
    read_exr(file("a.exr"), &attributes);
    EXPECT_EQ(attributes["interreflect.commit"], commit);
    EXPECT_EQ(Json::parse(output("info --json"))["commit"], commit);
}

}  // namespace
}  // namespace ir
