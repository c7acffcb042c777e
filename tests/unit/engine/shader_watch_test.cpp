#include "app/engine/shader_watch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <fstream>
#include <mutex>

namespace ir::engine {
namespace {

namespace fs = std::filesystem;

class ShaderWatchTest : public testing::Test {
  protected:
    void SetUp() override {
        folder = fs::path(testing::TempDir()) / "interreflect-shader-watch";
        fs::remove_all(folder);
        fs::create_directories(folder / "lib");
    }
    void TearDown() override { fs::remove_all(folder); }
    void hear() {
        const std::lock_guard lock(mutex);
        ++heard;
        changed.notify_all();
    }
    /// Whether something is heard of what `act` does.
    template <class Act>
    bool is_heard(Act act) {
        std::unique_lock lock(mutex);
        heard = 0;
        lock.unlock();
        act();
        lock.lock();
        return changed.wait_for(lock, std::chrono::minutes(1), [this] { return heard > 0; });
    }
    void write(const std::string& name) const { std::ofstream(folder / name) << name; }

    fs::path folder;
    std::mutex mutex;
    std::condition_variable changed;
    int heard = 0;
};

TEST_F(ShaderWatchTest, HearsOfFilesThatAreWrittenReplacedAndRemoved) {
    const ShaderWatch watch(folder, [this] { hear(); });
    EXPECT_TRUE(is_heard([&] { write("lib/a.glsl"); }));
    EXPECT_TRUE(is_heard([&] { write("lib/a.glsl"); }));
    EXPECT_TRUE(is_heard([&] { fs::rename(folder / "lib/a.glsl", folder / "lib/b.glsl"); }));
    EXPECT_TRUE(is_heard([&] { fs::remove(folder / "lib/b.glsl"); }));
}

TEST_F(ShaderWatchTest, HearsOfFilesInNewFolders) {
    const ShaderWatch watch(folder, [this] { hear(); });
    EXPECT_TRUE(is_heard([&] { fs::create_directories(folder / "methods/new"); }));
    EXPECT_TRUE(is_heard([&] { write("methods/new/a.comp"); }));
}

TEST_F(ShaderWatchTest, EndsAtOnceAlsoWithoutAFolder) {
    const ShaderWatch watch(folder / "nowhere", [] { FAIL(); });
}

}  // namespace
}  // namespace ir::engine
