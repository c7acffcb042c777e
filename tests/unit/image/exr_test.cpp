#include "renderers/image/exr.h"
#include "renderers/core/constants.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>

#include "renderers/core/error.h"
#include "temporary_folder.h"

namespace ir {
namespace {

/// Different in every pixel and channel, and under every flip.
Image pattern(int width, int height, int channels, float offset = 0) {
    Image image(width, height, channels);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) image.at(x, y, c) = offset + x + 10.5f * y + 1000.25f * c;
    return image;
}

ImageLayer layer(const std::string& name, const Image& image, bool vector_valued = false) {
    return {name, standard_channels(image.channels, vector_valued), image};
}

void expect_same_bits(const Image& a, const Image& b) {
    ASSERT_EQ(a.width, b.width);
    ASSERT_EQ(a.height, b.height);
    ASSERT_EQ(a.channels, b.channels);
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        ASSERT_EQ(std::bit_cast<std::uint32_t>(a.pixels[i]), std::bit_cast<std::uint32_t>(b.pixels[i])) << i;
}

const ImageLayer& find_layer(const std::vector<ImageLayer>& layers, const std::string& name) {
    for (const auto& each : layers)
        if (each.name == name) return each;
    throw Error("no layer " + name);
}

template <class Exception, class Action>
std::string message_of(Action action) {
    try {
        action();
    } catch (const Exception& error) {
        return error.what();
    }
    ADD_FAILURE() << "nothing of the expected type was thrown";
    return {};
}

TEST(Exr, KeepsLayersChannelsAndBits) {
    TemporaryFolder folder;
    Image special = pattern(7, 5, 1);
    special.at(0, 0) = infinity;
    special.at(1, 0) = -infinity;
    special.at(2, 0) = std::numeric_limits<float>::quiet_NaN();
    special.at(3, 0) = -0.0f;
    special.at(4, 0) = std::numeric_limits<float>::denorm_min();
    const std::vector<ImageLayer> written = {
        layer("", pattern(7, 5, 3)), layer("normal", pattern(7, 5, 3, 0.1f), true),
        layer("uv.offset", pattern(7, 5, 2)), layer("depth", special), layer("rgba", pattern(7, 5, 4))};
    write_exr(folder / "a.exr", written, {});
    const auto read = read_exr(folder / "a.exr");
    ASSERT_EQ(read.size(), written.size());
    EXPECT_EQ(read.front().name, "");
    for (const auto& each : written) {
        const auto& found = find_layer(read, each.name);
        EXPECT_EQ(found.channels, each.channels);
        expect_same_bits(found.image, each.image);
    }
    EXPECT_EQ(folder.files(), 1u) << "a temporary was left behind";
}

TEST(Exr, OtherSizesBecomeParts) {
    TemporaryFolder folder;
    const std::vector<ImageLayer> written = {layer("", pattern(8, 4, 1)), layer("half", pattern(4, 2, 3)),
                                             layer("main", pattern(3, 9, 1)), layer("ids", pattern(8, 4, 2)),
                                             layer("half.more", pattern(4, 2, 1, 5))};
    write_exr(folder / "a.exr", written, {{"seed", "7"}});
    ImageAttributes attributes;
    const auto read = read_exr(folder / "a.exr", &attributes);
    ASSERT_EQ(read.size(), written.size());
    for (const auto& each : written) {
        const auto& found = find_layer(read, each.name);
        EXPECT_EQ(found.channels, each.channels) << each.name;
        expect_same_bits(found.image, each.image);
    }
    EXPECT_EQ(attributes, (ImageAttributes{{"seed", "7"}}));
}

TEST(Exr, KeepsAttributes) {
    TemporaryFolder folder;
    const ImageAttributes written = {
        {"seed", "42"}, {"empty", ""}, {"parameters", "{\"max_distance\": 0.1, \"ä\": [1, 2]}\nsecond line"}};
    write_exr(folder / "a.exr", {layer("", pattern(2, 2, 1))}, written);
    ImageAttributes read;
    read_exr(folder / "a.exr", &read);
    EXPECT_EQ(read, written);
    EXPECT_THROW(write_exr(folder / "b.exr", {layer("", pattern(2, 2, 1))}, {{"channels", "x"}}), UsageError);
}

TEST(Exr, StandardChannelNames) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(standard_channels(1), (Names{"Y"}));
    EXPECT_EQ(standard_channels(2), (Names{"X", "Y"}));
    EXPECT_EQ(standard_channels(3), (Names{"R", "G", "B"}));
    EXPECT_EQ(standard_channels(4), (Names{"R", "G", "B", "A"}));
    EXPECT_EQ(standard_channels(3, true), (Names{"X", "Y", "Z"}));
    EXPECT_EQ(standard_channels(4, true), (Names{"X", "Y", "Z", "W"}));
    EXPECT_THROW(standard_channels(5), UsageError);
    EXPECT_THROW(standard_channels(0), UsageError);
}

TEST(Exr, FirstRowIsTheFileTop) {
    TemporaryFolder folder;
    Image image(3, 2, 1);
    image.pixels = {1, 2, 3, 4, 5, 6};
    write_exr(folder / "a.exr", {layer("", image)}, {});
    Imf::InputFile input((folder / "a.exr").c_str());
    float top[3] = {};  // scan line 0 of an EXR file is the top one
    Imf::FrameBuffer buffer;
    buffer.insert("Y", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(top), sizeof(float), 0));
    input.setFrameBuffer(buffer);
    input.readPixels(0, 0);
    EXPECT_EQ(top[0], 1);
    EXPECT_EQ(top[2], 3);
    expect_same_bits(read_image(folder / "a.exr"), image);
}

TEST(Exr, ReadsHalfFloatsAndShiftedDataWindows) {
    TemporaryFolder folder;
    Imf::Header header({{0, 0}, {9, 9}}, {{-2, 3}, {0, 4}});
    header.channels().insert("G", Imf::Channel(Imf::HALF));
    header.channels().insert("R", Imf::Channel(Imf::HALF));
    const std::vector<half> pixels = {1, 2, 3, 4, 5, 6};
    {
        Imf::OutputFile output((folder / "a.exr").c_str(), header);
        Imf::FrameBuffer buffer;
        char* origin = reinterpret_cast<char*>(const_cast<half*>(pixels.data()) + 2 - 3 * 3);
        for (const char* channel : {"R", "G"})
            buffer.insert(channel, Imf::Slice(Imf::HALF, origin, sizeof(half), 3 * sizeof(half)));
        output.setFrameBuffer(buffer);
        output.writePixels(2);
    }
    const auto layers = read_exr(folder / "a.exr");
    ASSERT_EQ(layers.size(), 1u);
    EXPECT_EQ(layers[0].channels, (std::vector<std::string>{"R", "G"}));
    ASSERT_EQ(layers[0].image.width, 3);
    ASSERT_EQ(layers[0].image.height, 2);
    EXPECT_EQ(layers[0].image.at(0, 0, 0), 1);
    EXPECT_EQ(layers[0].image.at(2, 1, 1), 6);
}

TEST(Exr, ChoosesLayers) {
    TemporaryFolder folder;
    write_exr(folder / "a.exr", {layer("", pattern(2, 2, 3)), layer("ao", pattern(2, 2, 1, 3))}, {});
    expect_same_bits(read_image(folder / "a.exr"), pattern(2, 2, 3));
    expect_same_bits(read_image(folder / "a.exr", "ao"), pattern(2, 2, 1, 3));
    const auto text = message_of<InputError>([&] { read_image(folder / "a.exr", "depth"); });
    EXPECT_NE(text.find("a.exr"), std::string::npos) << text;
    EXPECT_NE(text.find("'depth'"), std::string::npos) << text;
    EXPECT_NE(text.find("(default), ao"), std::string::npos) << text;
}

TEST(Exr, RefusesUnsoundLayers) {
    TemporaryFolder folder;
    const auto file = folder / "a.exr";
    EXPECT_THROW(write_exr(file, {}, {}), Error);
    EXPECT_THROW(write_exr(file, {layer("", pattern(1, 1, 1)), layer("", pattern(1, 1, 1))}, {}), Error);
    EXPECT_THROW(write_exr(file, {{"", {"R", "G"}, pattern(1, 1, 3)}}, {}), Error);
    EXPECT_THROW(write_exr(file, {{"", {"R", "R"}, pattern(1, 1, 2)}}, {}), Error);
    EXPECT_THROW(write_exr(file, {{"", {}, Image()}}, {}), Error);
    EXPECT_EQ(folder.files(), 0u);
}

TEST(Exr, ReadErrorsAreOneLineWithTheFile) {
    TemporaryFolder folder;
    EXPECT_NE(message_of<InputError>([&] { read_exr(folder / "none.exr"); }).find("none.exr"),
              std::string::npos);
    std::ofstream(folder / "text.exr") << "this is no image";
    EXPECT_EQ(message_of<InputError>([&] { read_exr(folder / "text.exr"); }),
              (folder / "text.exr").string() + ": is no EXR file");

    write_exr(folder / "whole.exr", {layer("", pattern(64, 64, 3))}, {});
    std::ifstream whole(folder / "whole.exr", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(whole), {}};
    std::ofstream(folder / "half.exr", std::ios::binary) << bytes.substr(0, bytes.size() / 2);
    const auto text = message_of<InputError>([&] { read_exr(folder / "half.exr"); });
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

TEST(Exr, RefusesSizesThatTheFileCannotHold) {
    TemporaryFolder folder;
    write_exr(folder / "small.exr", {layer("", pattern(16, 16, 1))}, {});
    std::ifstream small(folder / "small.exr", std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(small), {}};
    const auto window = bytes.find("dataWindow");
    ASSERT_NE(window, std::string::npos);
    // Name, type "box2i", size, then xMin, yMin, xMax, yMax.
    const auto corner = window + sizeof("dataWindow") + sizeof("box2i") + 4 + 8;
    for (const std::int32_t size : {16000, 2000000000}) {
        for (int k = 0; k < 2; ++k)
            for (int byte = 0; byte < 4; ++byte)
                bytes[corner + 4 * k + byte] = static_cast<char>(size >> (8 * byte));
        std::ofstream(folder / "huge.exr", std::ios::binary) << bytes;
        EXPECT_THROW(read_exr(folder / "huge.exr"), InputError) << size;
    }
}

/// OpenEXR holds what is packed as one beside the pixels: 0.4 GB of 16 long lines took 1.2 GB and 5 s.
TEST(Exr, BlocksOfLinesCountInTheLimit) {
    TemporaryFolder folder;
    const auto refusal = [&](int width, int height, Imf::Compression compression) {
        Imf::Header header(width, height);
        header.compression() = compression;
        header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
        Imf::OutputFile((folder / "a.exr").c_str(), header);  // without pixels
        return message_of<InputError>([&] { read_exr(folder / "a.exr"); });
    };
    const auto is_too_large = [&](const std::string& text) {
        return text.find("take far more memory than the file has bytes") != std::string::npos;
    };
    for (const auto compression : {Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION})
        EXPECT_TRUE(is_too_large(refusal(1 << 22, 16, compression))) << compression;
    EXPECT_TRUE(is_too_large(refusal(5 << 17, 128, Imf::ZIP_COMPRESSION))) << "threads hold eight blocks";
    EXPECT_FALSE(is_too_large(refusal(1 << 20, 16, Imf::ZIP_COMPRESSION)));
    EXPECT_FALSE(is_too_large(refusal(1 << 12, 1 << 12, Imf::ZIP_COMPRESSION)));
}

/// OpenEXR would take two gigabytes for what a file of 400 bytes claims.
TEST(Exr, RefusesAttributesThatAreLongerThanTheFile) {
    TemporaryFolder folder;
    write_exr(folder / "small.exr", {layer("", pattern(4, 4, 1)), layer("half", pattern(2, 2, 1))},
              {{"note", "short"}});
    std::ifstream small(folder / "small.exr", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(small), {}};
    EXPECT_NO_THROW(read_exr(folder / "small.exr"));
    for (const std::string& name :
         {std::string("note\0string", 11), std::string("compression\0compression", 23)}) {
        const auto at = bytes.rfind(name + '\0');
        ASSERT_NE(at, std::string::npos) << name;
        auto longer = bytes;
        longer[at + name.size() + 4] = 0x7f;  // the highest byte of its length
        std::ofstream(folder / "long.exr", std::ios::binary) << longer;
        for (const auto& read : {+[](const std::filesystem::path& file) { read_exr(file); },
                                 +[](const std::filesystem::path& file) { read_exr_attributes(file); }}) {
            try {
                read(folder / "long.exr");
                ADD_FAILURE() << name;
            } catch (const InputError& error) {
                EXPECT_NE(std::string(error.what()).find("is longer than the file or its type"),
                          std::string::npos)
                    << error.what();
            }
        }
    }
}

TEST(Exr, NamesCannotBreakTheLine) {
    TemporaryFolder folder;
    write_exr(folder / "whole.exr", {layer("", pattern(4, 4, 1))}, {});
    std::ifstream whole(folder / "whole.exr", std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(whole), {}};
    const auto channel = bytes.find(std::string("Y\0\2\0\0\0", 6));  // its type is float
    ASSERT_NE(channel, std::string::npos);
    bytes[channel] = '\n';
    bytes[channel + 2] = 9;  // no type at all
    std::ofstream(folder / "evil.exr", std::ios::binary) << bytes;
    try {
        read_exr(folder / "evil.exr");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
}

TEST(Exr, SurvivesDamage) {
    TemporaryFolder folder;
    write_exr(folder / "whole.exr", {layer("", pattern(24, 24, 3)), layer("half", pattern(12, 12, 1))}, {});
    std::ifstream whole(folder / "whole.exr", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(whole), {}};
    int refused = 0;
    for (std::size_t i = 0; i < bytes.size(); i += 7) {
        std::string damaged = bytes;
        damaged[i] = static_cast<char>(damaged[i] ^ (1 << (i % 8)));
        std::ofstream(folder / "damaged.exr", std::ios::binary) << damaged;
        try {
            read_exr(folder / "damaged.exr");
        } catch (const InputError&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 20);
}

TEST(Exr, KeepsTheOldFileWhenWritingFails) {
    TemporaryFolder folder;
    const auto text =
        message_of<Error>([&] { write_exr(folder / "none/a.exr", {layer("", pattern(1, 1, 1))}, {}); });
    EXPECT_NE(text.find("a.exr"), std::string::npos) << text;
    EXPECT_NE(text.find("writable"), std::string::npos) << text;

    write_exr(folder / "a.exr", {layer("", pattern(2, 2, 1))}, {});
    EXPECT_THROW(write_exr(folder / "a.exr", {{"", {"R", "G"}, pattern(1, 1, 1)}}, {}), Error);
    expect_same_bits(read_image(folder / "a.exr"), pattern(2, 2, 1));
}

TEST(Exr, ReadOnlyFolderIsRefused) {
    if (geteuid() == 0) GTEST_SKIP() << "the superuser writes into read-only folders";
    TemporaryFolder folder;
    std::filesystem::permissions(folder.path(),
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    EXPECT_THROW(write_exr(folder / "a.exr", {layer("", pattern(1, 1, 1))}, {}), Error);
    EXPECT_THROW(write_png(folder / "a.png", pattern(1, 1, 1)), Error);
    std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

}  // namespace
}  // namespace ir
