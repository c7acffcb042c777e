#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "renderers/core/error.h"
#include "renderers/image/codecs/jpeg.h"
#include "renderers/image/colour_map.h"
#include "renderers/image/exr.h"
#include "temporary_folder.h"
#include "tests/jpeg_of_scans.h"

namespace ir {
namespace {

bool is_loaded(const std::string& library) {
    std::ifstream maps("/proc/self/maps");
    const std::string text{std::istreambuf_iterator<char>(maps), {}};
    return text.find(library) != std::string::npos;
}

TEST(ImageCodecs, AreLoadedByTheFirstPictureThatNeedsThem) {
    if (is_loaded("libOpenImageIO")) GTEST_SKIP() << "another test of this process needed them";
    TemporaryFolder folder;
    write_exr(folder / "a.exr", {{"", {"Y"}, Image(2, 2, 1, 0.5f)}}, {});
    EXPECT_EQ(read_image(folder / "a.exr").width, 2);
    EXPECT_FALSE(is_loaded("libOpenImageIO"));
    write_png(folder / "a.png", Image(2, 2, 1, 0.5f));
    EXPECT_TRUE(is_loaded("libOpenImageIO"));
}

std::string refusal_of(const std::string& name, const std::string& bytes) {
    TemporaryFolder folder;
    std::ofstream(folder / name, std::ios::binary) << bytes;
    try {
        read_image(folder / name);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

/// OpenImageIO takes films, too, and a list of parts of a film names addresses.
TEST(ImageCodecs, OnlyPicturesAreRead) {
    const std::string list = "#EXTM3U\n#EXT-X-TARGETDURATION:1\n#EXTINF:1,\nhttp://127.0.0.1:9/a.ts\n";
    for (const char* name : {"a.m3u8", "a.png", "a.mp4", "a.avi", "a.null", "a.vdb", "a.dcm", "a.gif", "a"}) {
        const auto refusal = refusal_of(name, list);
        EXPECT_NE(refusal.find("none in EXR, HDR, PNG, JPEG, TIFF or WebP"), std::string::npos) << refusal;
    }
    EXPECT_NE(refusal_of("a.png", ""), "");
    EXPECT_NE(refusal_of("a.png", "\x89PNG"), "");
}

TEST(ImageCodecs, SizesThatNoFileOfItsLengthHasAreRefused) {
    const auto refusal = refusal_of("a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16000 +X 16000\n....");
    EXPECT_NE(refusal.find("has no sensible size"), std::string::npos) << refusal;
}

/// The most that this process held since it was last forgotten, in bytes; 0 where that is not told.
double peak_memory() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (double kib = 0; word == "VmHWM:" && status >> kib) return kib * 1024;
    return 0;
}

TEST(ImageCodecs, JpegFilesSayTheirSizeAndScans) {
    const auto outline = [](const std::string& bytes) {
        return jpeg_outline({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    };
    const auto bytes = test::jpeg_of_scans(3);
    const auto whole = outline(bytes);
    ASSERT_TRUE(whole);
    EXPECT_EQ(whole->width, 64);
    EXPECT_EQ(whole->height, 48);
    EXPECT_TRUE(whole->is_progressive);
    EXPECT_EQ(whole->scans, 3);
    EXPECT_EQ(whole->fault(), "");
    for (std::size_t length = 0; length < bytes.size(); ++length) outline(bytes.substr(0, length));
    EXPECT_FALSE(outline("\xff\xd8\xff\xd9"));
    EXPECT_FALSE(outline("no picture"));
}

/// Each goes over the whole picture: 4,800 of them in 1 MB took 49 s.
TEST(ImageCodecs, ScansWithoutEndAreRefused) {
    const auto refusal = refusal_of("a.jpg", test::jpeg_of_scans(101));
    EXPECT_NE(refusal.find("has 101 scans, more than 100"), std::string::npos) << refusal;
}

/// A small file may become large pictures: they are held once.
TEST(ImageCodecs, APictureIsHeldOnceWhileItIsRead) {
#ifdef INTERREFLECT_SANITIZED
    GTEST_SKIP() << "what sanitizers hold counts, too";
#endif
    TemporaryFolder folder;
    const Image large(3000, 3000, 3);
    const double bytes = double(large.pixels.size() * sizeof(float));
    write_png(folder / "a.png", large);
    if (!(std::ofstream("/proc/self/clear_refs") << "5" << std::flush)) GTEST_SKIP() << "peaks stay";
    const double before = peak_memory();
    const auto layers = read_layers(folder / "a.png");
    EXPECT_EQ(layers.front().image.width, large.width);
    EXPECT_LT(peak_memory() - before, 1.6 * bytes);
}

std::string big_endian(std::size_t number) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift);
    return bytes;
}

/// Of a PNG file [ISO/IEC 15948, 5.3 and annex D].
std::string chunk(const std::string& name_and_data) {
    std::uint32_t sum = 0xffffffff;
    for (const char c : name_and_data) {
        sum ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1 ? 0xedb88320 : 0);
    }
    return big_endian(name_and_data.size() - 4) + name_and_data + big_endian(~sum);
}

/// Packed, but not compressed [RFC 1950, RFC 1951].
std::string stored(const std::string& bytes) {
    constexpr std::uint32_t base = 65521;
    std::uint32_t a = 1, b = 0;
    for (const char c : bytes) {
        a = (a + static_cast<unsigned char>(c)) % base;
        b = (b + a) % base;
    }
    std::string packed = "\x78\x01\x01";
    for (const std::size_t length : {bytes.size(), ~bytes.size()})
        for (const int shift : {0, 8}) packed += static_cast<char>(length >> shift);
    return packed + bytes + big_endian(b << 16 | a);
}

struct SmallPng {
    int width = 1, height = 1, depth = 8, colour = 0;  ///< grey; 2: RGB, 3: palette, 4: grey and alpha
    std::string rows;                                  ///< each after the number of its filter
    std::string more_chunks = {};
    bool is_interlaced = false;

    std::string bytes() const {
        std::string header = "IHDR" + big_endian(std::size_t(width)) + big_endian(std::size_t(height));
        for (const int byte : {depth, colour, 0, 0, int(is_interlaced)}) header += static_cast<char>(byte);
        return "\x89PNG\r\n\x1a\n" + chunk(header) + more_chunks + chunk("IDAT" + stored(rows)) +
               chunk("IEND");
    }
};

TEST(ImageCodecs, PngFilesOfAllKindsAreWhatTheyShow) {
    using namespace std::string_literals;
    TemporaryFolder folder;
    const auto pixels = [&](const SmallPng& png) {
        std::ofstream(folder / "a.png", std::ios::binary) << png.bytes();
        return read_image(folder / "a.png").pixels;
    };
    using Pixels = std::vector<float>;
    const float part = float(0x80) * (1.0f / 255), linear = linear_from_srgb(part);
    const auto gamma = chunk("gAMA" + big_endian(100000)), srgb = chunk("sRGB\0"s);
    EXPECT_EQ(pixels({.width = 2, .depth = 1, .rows = "\0\x40"s}), (Pixels{0, 1}));
    EXPECT_EQ(pixels({.rows = "\0\x80"s}), (Pixels{linear}));
    EXPECT_EQ(pixels({.rows = "\0\x80"s, .more_chunks = gamma}), (Pixels{part}));
    EXPECT_EQ(pixels({.rows = "\0\x80"s, .more_chunks = gamma + srgb}), (Pixels{linear}));
    EXPECT_EQ(pixels({.colour = 2, .rows = "\0\xff\0\x80"s}), (Pixels{1, 0, linear}));
    EXPECT_EQ(pixels({.width = 2,
                      .colour = 3,
                      .rows = "\0\0\1"s,
                      .more_chunks = chunk("PLTE\xff\0\0\0\xff\0"s) + chunk("tRNS\x80"s)}),
              (Pixels{1, 0, 0, part, 0, 1, 0, 1}));
    EXPECT_EQ(pixels({.depth = 16, .colour = 4, .rows = "\0\xff\xff\x01\x02"s}),
              (Pixels{1, float(0x102) * (1.0f / 65535)}));
    EXPECT_EQ(pixels({.width = 2,
                      .height = 2,
                      .rows = "\0\xff\0\0\0\0\xff"s,
                      .more_chunks = gamma,
                      .is_interlaced = true}),
              (Pixels{1, 0, 0, 1}));
}

/// libpng would print by itself.
TEST(ImageCodecs, BrokenPngFilesAreOneLineOfOurs) {
    using namespace std::string_literals;
    const auto whole = SmallPng{.width = 2, .colour = 2, .rows = "\0\1\2\3\4\5\6"s}.bytes();
    testing::internal::CaptureStderr();
    std::string refusals;
    for (std::size_t i = 8; i < whole.size(); ++i) {
        auto broken = whole;
        broken[i] = static_cast<char>(broken[i] ^ 0x55);
        for (const auto& bytes : {broken, whole.substr(0, i)}) {
            const auto refusal = refusal_of("a.png", bytes);
            EXPECT_EQ(std::count(refusal.begin(), refusal.end(), '\n'), 0) << refusal;
            refusals += refusal + "\n";
        }
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    for (const auto* problem : {"CRC error", "it ends too soon", "IHDR"})
        EXPECT_NE(refusals.find(problem), std::string::npos) << problem << " in " << refusals;
}

/// Texts that become a thousand times as long: 135 of them in 1 MB took 4.7 s and 1.2 GB.
TEST(ImageCodecs, TextsOfPngFilesAreNotUnpacked) {
#ifdef INTERREFLECT_SANITIZED
    GTEST_SKIP() << "what sanitizers hold counts, too";
#endif
    using namespace std::string_literals;
    TemporaryFolder folder;
    const auto large = png_of(Image(2700, 2700, 1), 0);
    const auto data = large.find("IDAT");
    const auto zeros = large.substr(data + 4, large.find("IEND") - 4 - 4 - data - 4);
    auto bytes = png_of(Image(3, 2, 3, 1.0f), 0);
    std::string texts;
    for (int i = 0; i < 50; ++i) texts += chunk("zTXtkey\0\0"s + zeros);
    bytes.insert(bytes.find("IDAT") - 4, texts + chunk("iCCPprofile\0\0"s + zeros));
    std::ofstream(folder / "a.png", std::ios::binary) << bytes;
    if (!(std::ofstream("/proc/self/clear_refs") << "5" << std::flush)) GTEST_SKIP() << "peaks stay";
    const double before = peak_memory();
    EXPECT_EQ(read_image(folder / "a.png").pixels, std::vector<float>(18, 1.0f));
    EXPECT_LT(peak_memory() - before, 64e6);
}

/// Decoders hold interlaced pictures whole beside the floats.
TEST(ImageCodecs, WhatDecodersHoldCountsInTheLimit) {
    const auto header = [](int width, int height) {
        using namespace std::string_literals;
        return "\x89PNG\r\n\x1a\n"s +
               chunk("IHDR"s + big_endian(width) + big_endian(height) + "\x10\x02\0\0\x01"s) +
               chunk("IDAT"s) + chunk("IEND"s);
    };
    const auto large = refusal_of("a.png", header(6000, 6000));  // 0.65 GB with what the decoder holds
    EXPECT_NE(large.find("has no sensible size"), std::string::npos) << large;
    EXPECT_NE(refusal_of("a.png", header(500, 500)).find("is damaged"), std::string::npos);
}

}  // namespace
}  // namespace ir
