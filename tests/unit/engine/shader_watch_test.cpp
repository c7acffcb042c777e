#include "app/engine/shader_watch.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <fstream>
#include <mutex>
#include <set>

#include "tests/own_folder.h"

namespace ir::engine {
namespace {

namespace fs = std::filesystem;

class ShaderWatchTest : public testing::Test {
  protected:
    void SetUp() override {
        folder = own_folder("shader-watch");
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

TEST_F(ShaderWatchTest, AsksAgainWhereTheSystemHasNoDescriptorLeft) {
    const int first_free = ::dup(0);
    ::close(first_free);
    rlimit before;
    ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
    rlimit room_for_one = before;
    room_for_one.rlim_cur = rlim_t(first_free) + 1;
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &room_for_one), 0);
    const ShaderWatch watch(folder, [this] { hear(); });
    EXPECT_TRUE(is_heard([&] { ::setrlimit(RLIMIT_NOFILE, &before); }));
    EXPECT_TRUE(is_heard([&] { write("lib/a.glsl"); }));
}

/// Descriptors of this process that hear of files.
std::set<int> watching() {
    std::set<int> found;
    for (const auto& entry : fs::directory_iterator("/proc/self/fd")) {
        std::error_code ignored;
        if (fs::read_symlink(entry, ignored) == "anon_inode:inotify")
            found.insert(std::stoi(entry.path().filename()));
    }
    return found;
}

TEST_F(ShaderWatchTest, BeginsAnewWhereItsDescriptorFails) {
    const auto others = watching();
    ShaderWatch watch(folder, [this] { hear(); });
    auto own = watching();
    for (const int other : others) own.erase(other);
    ASSERT_EQ(own.size(), 1u);
    int ends[2];
    ASSERT_EQ(::pipe2(ends, O_CLOEXEC | O_NONBLOCK), 0);
    ASSERT_EQ(::dup2(ends[0], *own.begin()), *own.begin());
    for (const int end : ends)
        ::close(end);  // what is left of the pipe is ready for ever, with nothing to read
    EXPECT_TRUE(is_heard([&] { write("lib/a.glsl"); }));
    EXPECT_TRUE(is_heard([&] { write("lib/b.glsl"); }));
    EXPECT_EQ(watching().size(), others.size() + 1) << "it is woken for ever and hears nothing";
}

TEST_F(ShaderWatchTest, EndsAtOnceAlsoWithoutAFolder) {
    const ShaderWatch watch(folder / "nowhere", [] { FAIL(); });
}

}  // namespace
}  // namespace ir::engine
