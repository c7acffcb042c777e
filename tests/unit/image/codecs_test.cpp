#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

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

}  // namespace
}  // namespace ir
