// The real program: --screenshot ends, whatever it is asked to show and wherever it runs.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <QImage>
#include <filesystem>
#include <fstream>
#include <regex>

#include "tests/own_folder.h"
#include "tests/small_sample.h"

namespace ir {
namespace {

namespace fs = std::filesystem;

/// A guard for programs that hang; none of these takes a tenth of it.
constexpr int max_seconds = 200;

std::string contents(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// How the program meets its platform: what stands before it on the command line.
struct Platform {
    const char *name, *environment;
};

class Screenshot : public testing::TestWithParam<Platform> {
  protected:
    Screenshot() {
        std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
        std::replace(name.begin(), name.end(), '/', '-');
        root_ = own_folder("screenshot-" + name);
        fs::remove_all(root_);
        fs::create_directories(root_);
    }
    ~Screenshot() override { fs::remove_all(root_); }

    static void replace(const fs::path& project, const std::string& what, const std::string& with) {
        const auto text = contents(project / "project.json");
        std::ofstream(project / "project.json") << std::regex_replace(text, std::regex(what), with);
    }

    struct Outcome {
        int status = 0;
        std::string err;
        QImage picture;
    };
    Outcome shot(const fs::path& project) {
        const auto file = root_ / "window.png", err = root_ / "err";
        const std::string command = "timeout " + std::to_string(max_seconds) + " env " +
                                    GetParam().environment + " " + PROGRAM + " " + project.string() +
                                    " --layout picture --size 900x600 --screenshot " + file.string() + " 2>" +
                                    err.string();
        const int status = std::system(command.c_str());
        EXPECT_TRUE(WIFEXITED(status)) << command;
        return {WEXITSTATUS(status), contents(err), QImage(QString::fromStdString(file.string()))};
    }

    fs::path root_;
};

TEST_P(Screenshot, EndsWithTheSampleOfFilterStages) {
    const auto outcome = shot(test::small_sample("photon-fig7-2", root_));
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_GE(outcome.picture.width(), 900);
}

TEST_P(Screenshot, OfAMissingSceneSaysSoAndIsWrittenNevertheless) {
    const auto project = test::small_sample("photon-fig7-2", root_);
    replace(project, "builtin:conference@1[^\"]*", "gone.gltf");
    const auto outcome = shot(project);
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_NE(outcome.err.find("gone.gltf"), std::string::npos) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << "said once: " << outcome.err;
    EXPECT_GE(outcome.picture.width(), 900);
}

TEST_P(Screenshot, OfWhatIsNotThereOpensNoWindow) {
    const auto outcome = shot(root_ / "nowhere.glb");
    EXPECT_EQ(outcome.status, 3) << outcome.err;
    EXPECT_NE(outcome.err.find("nowhere.glb: there is no such file or folder; check the path"),
              std::string::npos)
        << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_TRUE(outcome.picture.isNull());
}

INSTANTIATE_TEST_SUITE_P(
    , Screenshot,
    testing::Values(Platform{"default", ""}, Platform{"offscreen", "QT_QPA_PLATFORM=offscreen"},
                    Platform{"without_display", "-u DISPLAY -u WAYLAND_DISPLAY -u QT_QPA_PLATFORM"}),
    [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace ir
