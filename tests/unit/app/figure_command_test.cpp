// `figure` on the real program, and what it draws.
#include <cmath>

#include "app/report/figure.h"
#include "renderers/core/error.h"
#include "renderers/image/colour_map.h"
#include "renderers/image/exr.h"
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

using report::Figure;
using report::FigureFormat;

/// Every pixel has a colour of its own.
report::FigurePicture picture(const std::string& label, int width = 32, int height = 24, float more = 0) {
    auto side = std::make_shared<engine::Side>();
    side->image = Image(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            side->image.at(x, y, 0) = float(x) / float(width) + more;
            side->image.at(x, y, 1) = float(y) / float(height);
            side->image.at(x, y, 2) = 0.25f;
        }
    auto raster = std::make_shared<const report::Raster>(report::raster_of(*side, {}, "grey"));
    return {label, side, raster};
}

class FigureCommand : public CommandTest {
  protected:
    Image drawn(const Figure& figure) const {
        std::ofstream(file("figure.png"), std::ios::binary) << draw_figure(figure, FigureFormat::png);
        return read_image(file("figure.png"));
    }
    void expect_colour(const Image& image, double x, double y, std::array<float, 3> linear,
                       const std::string& what) const {
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(image.at(int(x), int(y), c), linear[std::size_t(c)], 0.01)
                << what << " channel " << c;
    }
    static std::array<float, 3> colour_of_frame(std::size_t inset) {
        const auto hex = report::frame_colour(inset);
        std::array<float, 3> colour{};
        for (std::size_t c = 0; c < 3; ++c)
            colour[c] = linear_from_srgb(float(std::stoi(hex.substr(1 + 2 * c, 2), nullptr, 16)) / 255);
        return colour;
    }
    void write_pictures() const {
        for (const auto& [name, more] : {std::pair{"far", 0.3f}, {"near", 0.1f}, {"truth", 0.0f}})
            write_exr(file(std::string(name) + ".exr"),
                      {{"", {"R", "G", "B"}, picture("", 32, 24, more).side->image}}, {});
        files_ = file("far.exr") + " " + file("near.exr") + " " + file("truth.exr") + " ";
    }
    mutable std::string files_;
};

TEST_F(FigureCommand, InsetsThatAreNarrowerThanTheirPictureStandInItsMiddle) {
    Figure figure;
    figure.pictures = {picture("")};
    figure.insets = {{4, 6, 8, 8}};
    figure.width = 100;
    figure.dots_per_inch = 254;  // ten a millimetre
    const auto image = drawn(figure);
    const double side = 600, left = (1000 - side) / 2;  // no higher than 0.6 of the picture's width
    const double y = image.height - side / 2;
    const std::array<float, 3> white{1, 1, 1};
    expect_colour(image, left + 2, y, colour_of_frame(0), "the inset's frame at its left");
    expect_colour(image, left + side - 3, y, colour_of_frame(0), "and at its right");
    expect_colour(image, left / 2, y, white, "beside it");
    expect_colour(image, 1000 - left / 2, y, white, "on both sides");
}

TEST_F(FigureCommand, PixelsStayPixelsAndInsetsAreZoomed) {
    Figure figure;
    figure.pictures = {picture("")};
    figure.insets = {{4, 6, 8, 8}, {20, 2, 8, 8}};
    figure.width = 100;
    figure.dots_per_inch = 254;  // ten a millimetre
    const auto image = drawn(figure);
    EXPECT_EQ(image.width, 1000);
    const double scale = 1000.0 / 32, gap = 2 / 72.0 * 254, inset = (1000 - gap) / 2;
    EXPECT_NEAR(image.height, 24 * scale + gap + inset, 6);
    const auto value = [&](int x, int y) { return std::array{float(x) / 32, float(y) / 24, 0.25f}; };
    expect_colour(image, 15.5 * scale, 20.5 * scale, value(15, 20), "the picture");
    expect_colour(image, 15.1 * scale, 20.9 * scale, value(15, 20), "not blurred");
    const double top = 24 * scale + gap;
    for (const int at : {1, 4, 6}) {
        const double x = (at + 0.5) * inset / 8, y = top + (at + 0.5) * inset / 8;
        expect_colour(image, x, y, value(4 + at, 6 + at), "first inset");
        expect_colour(image, x + inset + gap, y, value(20 + at, 2 + at), "second inset");
    }
    // Frames, on the picture and around the insets, have one colour each.
    expect_colour(image, 8 * scale, 6 * scale, colour_of_frame(0), "frame on the picture");
    expect_colour(image, 24 * scale, 2 * scale, colour_of_frame(1), "second frame on the picture");
    expect_colour(image, 2, top + inset / 2, colour_of_frame(0), "frame of the inset");
    expect_colour(image, inset + gap + 2, top + inset / 2, colour_of_frame(1), "frame of the second inset");
    EXPECT_NE(colour_of_frame(0), colour_of_frame(1));
}

TEST_F(FigureCommand, LabelsAndNumbersStandBeneathEachPicture) {
    Figure figure;
    figure.pictures = {picture("far", 32, 24, 0.3f), picture("near", 32, 24, 0.1f), picture("truth")};
    figure.width = 150;
    const auto bare = drawn(figure).height;
    figure.metrics = {"rmse", "mae"};
    EXPECT_EQ(drawn(figure).height, bare) << "without a reference there are none";
    figure.reference = 2;
    const auto with = drawn(figure);
    EXPECT_NEAR(with.height - bare, 2 * 1.3 * 8 / 72 * 300, 2);
    const auto ink = [&](int column) {  // of the numbers
        int dark = 0;
        for (int y = bare; y < with.height; ++y)
            for (int x = column * with.width / 3; x < (column + 1) * with.width / 3; ++x)
                dark += with.at(x, y, 0) < 0.2f;
        return dark;
    };
    EXPECT_GT(ink(0), 200);
    EXPECT_GT(ink(1), ink(0)) << "the best ones are bold";
    EXPECT_EQ(ink(2), 0) << "the reference has none";
    figure.columns = 2;
    EXPECT_GT(drawn(figure).height, 2 * bare) << "two rows of larger pictures";
}

TEST_F(FigureCommand, NumbersWithoutLabelsStandInsideTheFigure) {
    Figure figure;
    figure.pictures = {picture("", 32, 24, 0.3f), picture("")};
    figure.width = 100;
    const auto bare = drawn(figure).height;
    figure.metrics = {"rmse", "mae"};
    figure.reference = 1;
    const auto image = drawn(figure);
    const auto has_ink = [&](int from, int to) {
        for (int y = from; y < to; ++y)
            for (int x = 0; x < image.width; ++x)
                if (image.at(x, y, 0) < 0.2f) return true;
        return false;
    };
    const int line = (image.height - bare) / 2;
    EXPECT_TRUE(has_ink(bare, bare + line)) << "the first number";
    EXPECT_TRUE(has_ink(image.height - line, image.height)) << "the last number";
    EXPECT_FALSE(has_ink(image.height - 2, image.height)) << "nothing is cut off";
}

TEST_F(FigureCommand, ARangeIsWhatColoursSpan) {
    write_pictures();
    output("figure " + file("truth.exr") + " --range 0,0.5 --out " + file("f.png"));
    const auto image = read_image(file("f.png"));
    const int row = image.height / 3;  // values of the columns are x / 32
    EXPECT_NEAR(image.at(image.width * 9 / 64, row, 0), 2 * 4.0f / 32, 0.01);
    EXPECT_NEAR(image.at(image.width * 3 / 4, row, 0), 1, 0.01);
}

TEST_F(FigureCommand, WritesAllThreeFormats) {
    write_pictures();
    for (const auto& [name, begin] :
         {std::pair{"f.pdf", "%PDF-1."}, {"f.svg", "<?xml"}, {"f.png", "\x89PNG"}}) {
        EXPECT_EQ(output("figure " + files_ + "--inset 4,4,8,8 --metric rmse,flip --out " + file(name)), "");
        const auto bytes = read(file(name));
        EXPECT_TRUE(bytes.starts_with(begin)) << name;
        EXPECT_GT(bytes.size(), 2000u) << name;
    }
    const auto pdf = read(file("f.pdf"));
    EXPECT_NE(pdf.find("/FontFile"), std::string::npos) << "letters are embedded";
    EXPECT_NE(pdf.find("/Interpolate false"), std::string::npos);
    EXPECT_EQ(pdf.find("/Interpolate true"), std::string::npos) << "readers blur no pixels";
    const auto image = read_image(file("f.png"));
    EXPECT_EQ(image.width, int(std::ceil(178 / 25.4 * 300)));
    output("figure " + files_ + "--width 86 --dpi 100 --out " + file("small.png"));
    EXPECT_EQ(read_image(file("small.png")).width, int(std::ceil(86 / 25.4 * 100)));
}

TEST_F(FigureCommand, RefusesInOneLineWhatCannotBeDrawn) {
    write_pictures();
    const auto out = " --out " + file("f.pdf");
    expect_refused("figure " + files_ + "--out " + file("f.tiff"), 2, "ends with .pdf, .svg or .png");
    expect_refused("figure " + files_ + "--inset 30,4,8,8" + out, 2, "leaves the pictures");
    expect_refused("figure " + files_ + "--inset 4,4,8" + out, 2, "x,y,width,height");
    expect_refused("figure " + files_ + "--metric rmsd" + out, 2, "did you mean 'rmse'?");
    expect_refused("figure " + files_ + "--reference trut" + out, 2, "did you mean 'truth'?");
    expect_refused("figure " + files_ + "--width 5" + out, 2, "20 to 1000 mm");
    std::string many, insets;
    for (int i = 0; i < 16; ++i) many += file("truth.exr") + " ";
    for (int i = 0; i < 8; ++i) insets += "--inset 4,4,8,8 ";
    expect_refused("figure " + many + "--metric none --width 20" + out, 2, "too narrow");
    expect_refused("figure " + many + many + "--metric none " + insets + out, 2, "too narrow");
    expect_refused("figure " + files_ + "--range 3,1" + out, 2, "lo < hi");
    expect_refused("figure " + files_ + "--label a --label b --label c --label d" + out, 2, "more --label");
    expect_refused("figure " + file("nothing.exr") + out, 3, "nothing.exr");
    expect_refused("figure " + file("nowhere") + out, 3, "is not there");
    expect_refused("figure " + files_ + "--out " + file("truth.exr"), 2, "ends with");
    write_exr(file("small.exr"), {{"", {"R", "G", "B"}, Image(8, 8, 3)}}, {});
    expect_refused("figure " + file("small.exr") + " " + files_ + out, 2, "8x8");
    EXPECT_FALSE(fs::exists(file("f.pdf")));
}

}  // namespace
}  // namespace ir
