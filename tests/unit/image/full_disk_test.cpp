// Pictures are whole or the ones that stood there before, with every amount of room.
#include <gtest/gtest.h>

#include "renderers/image/exr.h"
#include "temporary_folder.h"
#include "test_pictures.h"
#include "tests/unit/scarce_disk.h"

namespace ir {
namespace {

namespace fs = std::filesystem;

using Write = std::function<void(const fs::path& file, const Image& image)>;

void write_layers(const fs::path& file, const Image& image) {
    Image half(image.width / 2, image.height / 2, 1, 0.5f);
    write_exr(file, {{"", {"R", "G", "B"}, image}, {"half", {"Y"}, half}}, {{"note", std::string(99, 'n')}});
}

struct Format {
    const char* file;
    Write write;
};

void PrintTo(const Format& format, std::ostream* out) {
    *out << format.file;
}

const Format formats[] = {{"a.exr", write_layers},
                          {"a.png", [](const auto& file, const auto& image) { write_png(file, image); }}};

Ordeal ordeal_of(const Format& format, int size) {
    static const std::string before = "the picture before";
    const auto image = test::colourful(size, size);
    return {[=](const fs::path& disk) { write_bytes(disk / format.file, before); },
            [=](const fs::path& disk) { format.write(disk / format.file, image); },
            [=](const fs::path& disk, bool done) -> std::string {
                const auto file = disk / format.file;
                if (!done) return read_bytes(file) == before ? "" : "the picture before is gone";
                return read_image(file).pixels.size() == image.pixels.size() ? "" : "another picture";
            }};
}

class FullDisk : public testing::TestWithParam<Format> {
  protected:
    TemporaryFolder folder;
};

TEST_P(FullDisk, WithEveryLimitOnTheSizeOfFiles) {
    EXPECT_EQ(with_small_files(folder.path(), ordeal_of(GetParam(), 16), 53), "ok");
    EXPECT_EQ(with_small_files(folder.path(), ordeal_of(GetParam(), 96), 1999), "ok");
}

TEST_P(FullDisk, WithEveryNumberOfFreePages) {
    for (const int size : {2, 16, 96}) {
        const auto answer = with_few_pages(folder.path(), ordeal_of(GetParam(), size));
        if (answer == "not allowed")
            GTEST_SKIP() << "needs the right to mount; its twin limits the size of files";
        EXPECT_EQ(answer, "ok") << size;
    }
}

INSTANTIATE_TEST_SUITE_P(Pictures, FullDisk, testing::ValuesIn(formats),
                         [](const auto& info) { return std::string(info.param.file).substr(2); });

}  // namespace
}  // namespace ir
