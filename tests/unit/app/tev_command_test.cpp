// `tev` on the real program.
#include <future>

#include "renderers/image/exr.h"
#include "tests/fake_tev.h"
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

class TevCommand : public CommandTest {};

TEST_F(TevCommand, ShowsAPictureOfEachSizeOfAFile) {
    Image picture(4, 3, 3, 0.5f), grid(2, 2, 1, 7);
    write_exr(file("a.exr"), {{"", {"R", "G", "B"}, picture}, {"grid", {"Y"}, grid}}, {});
    FakeTev tev;
    auto received = std::async(std::launch::async, [&] {
        auto shown = tev.receive();
        shown.merge(tev.receive());
        return shown;
    });
    const auto outcome = run("tev " + file("a.exr") + " --to " + tev.address());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const auto shown = received.get();
    ASSERT_EQ(shown.size(), 2u);
    EXPECT_EQ(shown.at(file("a.exr") + " 4x3").image.pixels, picture.pixels);
    EXPECT_EQ(shown.at(file("a.exr") + " 2x2").image.pixels, grid.pixels);
    EXPECT_EQ(shown.at(file("a.exr") + " 2x2").channels, std::vector<std::string>{"grid.Y"});
}

TEST_F(TevCommand, SaysWhatIsWrongInOneLine) {
    write_exr(file("a.exr"), {{"", {"Y"}, Image(2, 2, 1)}}, {});
    std::string closed;
    { closed = FakeTev().address(); }
    const auto refused = run("tev " + file("a.exr") + " --to " + closed);
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find("tev at " + closed), std::string::npos) << refused.err;
    EXPECT_EQ(run("tev " + file("a.exr") + " --to here").status, 2);
    EXPECT_EQ(run("tev " + file("missing.exr")).status, 3);
}

}  // namespace
}  // namespace ir
