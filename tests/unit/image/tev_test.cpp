#include "renderers/image/tev.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <future>

#include "renderers/core/error.h"
#include "tests/fake_tev.h"

namespace ir {
namespace {

Image numbered(int width, int height, int channels, float first) {
    Image image(width, height, channels);
    for (auto& value : image.pixels) value = first++;
    return image;
}

TEST(Tev, GetsEveryValueOfEveryLayer) {
    FakeTev tev;
    auto received = std::async(std::launch::async, [&] { return tev.receive(); });
    const auto colour = numbered(5, 3, 3, 0), depth = numbered(5, 3, 1, 1000);
    send_to_tev("a picture", {{"", {"R", "G", "B"}, colour}, {"depth", {"Z"}, depth}}, tev.address());
    const auto shown = received.get();
    ASSERT_EQ(shown.size(), 1u);
    ASSERT_EQ(shown.begin()->first, "a picture");
    const auto& [channels, image, is_set] = shown.begin()->second;
    EXPECT_EQ(channels, (std::vector<std::string>{"R", "G", "B", "depth.Z"}));
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x) {
            for (int c = 0; c < 3; ++c) EXPECT_EQ(image.at(x, y, c), colour.at(x, y, c));
            EXPECT_EQ(image.at(x, y, 3), depth.at(x, y));
        }
}

TEST(Tev, LargePicturesComeInParts) {
    FakeTev tev;
    auto received = std::async(std::launch::async, [&] { return tev.receive(); });
    const auto large = numbered(2048, 1100, 3, 0);
    send_to_tev("large", {{"", {"R", "G", "B"}, large}}, tev.address());
    const auto shown = received.get().at("large");
    EXPECT_EQ(shown.image.pixels, large.pixels);
    EXPECT_TRUE(std::all_of(shown.is_set.begin(), shown.is_set.end(), [](bool set) { return set; }));
}

std::string refusal(const std::vector<ImageLayer>& layers, const std::string& address) {
    try {
        send_to_tev("name", layers, address);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Tev, WhatCannotBeShownIsSaidInOneLine) {
    const std::vector<ImageLayer> one = {{"", {"Y"}, Image(2, 2, 1)}};
    EXPECT_EQ(refusal(one, "nowhere"),
              "'nowhere' is no address of tev; give HOST:PORT, such as 127.0.0.1:14158");
    for (const char* port : {"0", "65536", "99999999999999999999", "abc", "1 2"})
        EXPECT_NE(refusal(one, "127.0.0.1:" + std::string(port)).find("no port"), std::string::npos) << port;
    std::string closed;
    { closed = FakeTev().address(); }
    EXPECT_EQ(refusal(one, closed),
              "tev at " + closed + ": Connection refused; start it, or name where it runs");
    EXPECT_NE(refusal({}, closed).find("no picture"), std::string::npos);
    EXPECT_NE(refusal({one[0], {"b", {"Y"}, Image(3, 2, 1)}}, closed).find("different sizes"),
              std::string::npos);
}

}  // namespace
}  // namespace ir
