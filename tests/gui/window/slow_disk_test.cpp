// A disk that takes its time: the window goes on drawing.
#include <unistd.h>

#include <QTemporaryDir>
#include <QTimer>
#include <atomic>
#include <chrono>
#include <thread>

#include "tests/gui/window/window_fixture.h"

namespace {

/// What the window's thread has done, in beats of a timer.
std::atomic<long> beats = 0;
std::atomic<bool> syncs_are_slow = false, reads_are_slow = false;
std::atomic<int> syncs = 0, reads = 0, unheard = 0;

/// A slow disk waits until the window has drawn for a while; one that waits for the disk never does.
void wait_for_the_disk(std::atomic<int>& done) {
    using namespace std::chrono_literals;
    const long wanted = beats + 20;
    const auto end = std::chrono::steady_clock::now() + 4s;
    while (beats < wanted && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(1ms);
    unheard += beats < wanted;
    ++done;
}

}  // namespace

extern "C" {

// The linker puts us between (--wrap).

int __real_fsync(int descriptor);
int __wrap_fsync(int descriptor) {
    if (syncs_are_slow) wait_for_the_disk(syncs);
    return __real_fsync(descriptor);
}

ssize_t __real_read(int descriptor, void* bytes, size_t count);
ssize_t __wrap_read(int descriptor, void* bytes, size_t count) {
    if (reads_are_slow) wait_for_the_disk(reads);
    return __real_read(descriptor, bytes, count);
}
}

namespace ir::gui {
namespace {

class SlowDisk : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
        window.session().files().save_as(folder());
        beats = 0;
        syncs = reads = unheard = 0;
        QObject::connect(&heart_, &QTimer::timeout, [] { ++beats; });
        heart_.start(1);
        syncs_are_slow = true;
    }
    void TearDown() override {
        syncs_are_slow = reads_are_slow = false;
        WindowTest::TearDown();
    }
    std::filesystem::path folder() const { return temporary_.path().toStdString() + "/a.interreflect"; }
    void write_notes(const std::string& notes) {
        window.session().edit(
            [&](const projects::Project& project) { return projects::edits::set_notes(project, notes); });
    }
    std::string saved_notes() { return projects::load_project(folder(), fake_registry()).project.notes; }

    const QTemporaryDir temporary_;
    QTimer heart_;
};

TEST_F(SlowDisk, TheWindowDrawsWhileItSaves) {
    write_notes("new");
    reads_are_slow = true;
    trigger("save");
    EXPECT_GE(syncs, 4) << "two files and their folder";
    EXPECT_GE(reads, 1) << "the lock";
    EXPECT_EQ(unheard, 0);
    EXPECT_FALSE(window.isWindowModified());
    EXPECT_EQ(saved_notes(), "new");
}

TEST_F(SlowDisk, TheWindowDrawsWhileItOpens) {
    write_notes("kept");
    trigger("save");
    window.session().files().close();
    reads_are_slow = true;
    ASSERT_TRUE(window.open_path(QString::fromStdString(folder().string())));
    EXPECT_GE(reads, 1);
    EXPECT_EQ(unheard, 0);
    EXPECT_EQ(window.session().document().notes, "kept");
}

/// Or a screenshot would be taken of half a project.
TEST_F(SlowDisk, AWindowThatWaitsForTheDiskIsNotSettled) {
    window.session().files().close();
    EXPECT_TRUE(QTest::qWaitFor([&] { return window.is_settled(); }));
    int looks = 0, settled = 0;
    const auto looking = QObject::connect(&heart_, &QTimer::timeout, &window, [&] {
        ++looks;
        settled += window.is_settled();
    });
    reads_are_slow = true;
    ASSERT_TRUE(window.open_path(QString::fromStdString(folder().string())));
    QObject::disconnect(looking);
    EXPECT_GE(looks, 1);
    EXPECT_EQ(settled, 0);
}

TEST_F(SlowDisk, WhatIsChangedMeanwhileIsNotSavedYet) {
    write_notes("first");
    QTimer::singleShot(0, [&] { write_notes("second"); });
    trigger("save");
    EXPECT_EQ(saved_notes(), "first");
    EXPECT_EQ(window.session().document().notes, "second");
    EXPECT_TRUE(window.isWindowModified());
    trigger("save");
    EXPECT_EQ(saved_notes(), "second");
    EXPECT_FALSE(window.isWindowModified());
}

TEST_F(SlowDisk, WhatSavesByItselfIsNotFelt) {
    write_notes("new");
    window.session().files().autosave();
    trigger("save");  // waits for the autosave
    EXPECT_EQ(unheard, 0);
    EXPECT_EQ(saved_notes(), "new");
    EXPECT_FALSE(std::filesystem::exists(folder() / projects::autosave_file_name));
}

TEST_F(SlowDisk, NothingIsLostWhereTheProgramIsToldToEndMeanwhile) {
    write_notes("first");
    QTimer::singleShot(0, [&] {
        write_notes("second");
        window.leave();
    });
    trigger("save");
    EXPECT_EQ(unheard, 0);
    const auto recovery = projects::find_recovery(folder(), fake_registry());
    ASSERT_TRUE(recovery);
    EXPECT_EQ(recovery->project.notes, "second");
}

}  // namespace
}  // namespace ir::gui
