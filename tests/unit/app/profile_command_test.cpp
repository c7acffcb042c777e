// `profile` on the real program.
#include "renderers/image/exr.h"
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

class ProfileCommand : public CommandTest {
  protected:
    void SetUp() override {
        CommandTest::SetUp();
        write("a.exr", 1);
        write("b.exr", 2);
        both_ = "profile " + file("a.exr") + " " + file("b.exr") + " ";
    }
    void write(const std::string& name, float factor) const {
        Image image(16, 12, 3), valid(16, 12, 1, 1);
        for (int y = 0; y < 12; ++y)
            for (int x = 0; x < 16; ++x)
                for (int c = 0; c < 3; ++c) image.at(x, y, c) = factor * float(x + 16 * y + c);
        valid.at(6, 4) = 0;
        write_exr(file(name), {{"", {"R", "G", "B"}, image}, {"valid", {"Y"}, valid}}, {});
    }
    std::string both_;
};

TEST_F(ProfileCommand, PrintsWhatEachPictureHasAlongTheLine) {
    EXPECT_EQ(output(both_ + "--line 4,4,8,4 --channel G"),
              "x,y,distance," + file("a.exr") + "  G," + file("b.exr") + "  G\n" +
                  "4,4,0,69,138\n5,4,1,70,140\n6,4,2,,\n7,4,3,72,144\n8,4,4,73,146\n");
}

TEST_F(ProfileCommand, WritesATableAndADrawing) {
    EXPECT_EQ(
        output(both_ + "--line 2,9,2,1 --channel each --csv " + file("p.csv") + " --svg " + file("p.svg")),
        "");
    const auto csv = read(file("p.csv")), svg = read(file("p.svg"));
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 10);
    EXPECT_TRUE(svg.starts_with("<svg "));
    EXPECT_NE(svg.find("b.exr  B</text>"), std::string::npos);
}

TEST_F(ProfileCommand, WritesOverNoPictureThatItReads) {
    const auto before = read(file("a.exr"));
    expect_refused(both_ + "--line 4,4,8,4 --csv " + file("a.exr"), 2, "is the file of FILE");
    expect_refused(both_ + "--line 4,4,8,4 --csv " + file("p") + " --svg " + file("p"), 2,
                   "is the file of --csv");
    expect_refused(both_ + "--line 4,4,8,4 --svg " + file("none/p.svg"), 2, "--svg");
    EXPECT_EQ(read(file("a.exr")), before);
}

TEST_F(ProfileCommand, RefusesWhatIsNoLineOrChannelInOneLine) {
    expect_refused(both_ + "--line 4,4,16,4", 2, "which has 16x12 pixels");
    expect_refused(both_ + "--line 4,4,8", 2, "is not of the form x1,y1,x2,y2");
    expect_refused(both_ + "--line 4,4,8.5,4", 2, "must hold whole numbers of pixels");
    expect_refused(both_ + "--line 4,4,8,4 --channel Q", 2, "is none of the pictures'");
    expect_refused(both_ + "--line 4,4,8,4 --layer depth", 3, "depth");
    expect_refused(both_, 2, "--line");
}

}  // namespace
}  // namespace ir
