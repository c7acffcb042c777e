// A command that is refused memory ends with a line, and leaves a whole picture or none.
#include "renderers/image/exr.h"
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

class RefusedMemory : public CommandTest {
  protected:
    void SetUp() override {
#ifdef INTERREFLECT_SANITIZED
        GTEST_SKIP() << "a sanitizer must be loaded first";
#endif
        CommandTest::SetUp();
    }
    /// As a shell counts: 128 more where a signal ended it. `at` 0: nothing is refused.
    int run_refused(long at, const std::string& arguments) const {
        const auto command =
            "ulimit -c 0; exec env LD_PRELOAD=" REFUSE_MEMORY_LIBRARY +
            (at > 0 ? " REFUSE_AT=" + std::to_string(at) : " REFUSE_COUNT=" + file("count")) + " " +
            CLI_PROGRAM + " " + arguments + " >" + file("stdout") + " 2>" + file("stderr");
        const int status = std::system(command.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    /// Allocations of a command that nothing is refused.
    long allocations(const std::string& arguments) const {
        EXPECT_EQ(run_refused(0, arguments), 0) << read(file("stderr"));
        return std::stol(read(file("count")));
    }
};

TEST_F(RefusedMemory, RenderingEndsWithALineAndAWholePictureOrNone) {
    const auto picture = file("out/a.exr");
    const auto arguments =
        "render --scene builtin:cornell --size 8x8 --quiet --method ldm-ao --set "
        "directions=16 --set resolution=32 --threads 1 --out " +
        picture;
    fs::create_directories(file("out"));
    const long first = allocations("--version");  // what comes before is that of static objects
    const long last = allocations(arguments);
    const auto whole = read_image(picture);
    ASSERT_GT(last, first + 1000);
    const long most = std::getenv("INTERREFLECT_ALL_REFUSALS") ? last - first : 24;
    long failed = 0, aborted = 0;
    for (long i = 0; i < most; ++i) {
        fs::remove(picture);
        const long at = first + 1 + i * (last - first) / most;
        const int status = run_refused(at, arguments);
        const auto said = read(file("stderr"));
        aborted += status == 128 + SIGABRT;
        failed += status == 1;
        if (status == 1) {
            EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
            EXPECT_NE(said.find("interreflect-cli: "), std::string::npos) << said;
        } else {
            EXPECT_TRUE(status == 0 || status == 128 + SIGABRT) << status << said;
        }
        EXPECT_TRUE(!fs::exists(picture) || read_image(picture).pixels == whole.pixels);
        if (HasFailure()) FAIL() << "refused at " << at << " of " << last;
    }
    EXPECT_GT(failed, most / 2);
    // Nested initialisers that are interrupted are destroyed twice by GCC 12, and destructors of JSON values
    // want memory themselves.
    EXPECT_LE(aborted, most / 6);
    RecordProperty("allocations", int(last - first));
    RecordProperty("aborted", int(aborted));
}

}  // namespace
}  // namespace ir
