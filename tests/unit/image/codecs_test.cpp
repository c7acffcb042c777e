#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "renderers/core/error.h"
#include "renderers/image/exr.h"
#include "temporary_folder.h"

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

}  // namespace
}  // namespace ir
