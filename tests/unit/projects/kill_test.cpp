#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <random>
#include <thread>

#include "tests/unit/projects/numbered.h"
#include "tests/unit/projects/sample.h"

/// The real thing: a process that edits, saves and autosaves on the real disk gets SIGKILL at random moments.
namespace ir::projects {
namespace {

namespace fs = std::filesystem;
using testing::open_again;
using testing::registry;
using testing::TemporaryFolder;

/// What the child says that it has done, in memory that outlives it.
struct Diary {
    std::atomic<int> save_begun, saved;  ///< numbers of states
    std::atomic<int> autosaved;
};
static_assert(std::atomic<int>::is_always_lock_free);

class SharedDiary {
  public:
    SharedDiary()
        : memory_(::mmap(nullptr, sizeof(Diary), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    }
    ~SharedDiary() { ::munmap(memory_, sizeof(Diary)); }
    SharedDiary(const SharedDiary&) = delete;
    SharedDiary& operator=(const SharedDiary&) = delete;
    Diary* operator->() { return static_cast<Diary*>(memory_); }

  private:
    void* memory_;
};

/// Runs in the child until it is killed: every state is edited, sometimes autosaved, sometimes saved.
[[noreturn]] void work_for_ever(const fs::path& folder, int first, unsigned seed, SharedDiary& diary) {
    std::mt19937 random(seed);
    OpenProject open(folder, registry());
    for (int state = first;; ++state) {
        testing::edit_to(open, state);
        const auto choice = random() % 4;
        if (choice < 3) {
            open.autosave();
            if (choice == 0) {
                open.wait_for_autosave();
                diary->autosaved = state;
            }
        }
        if (choice % 2 == 1) {
            diary->save_begun = state;
            open.save();
            diary->saved = state;
        }
    }
}

/// Starts a child, kills it after a while that the seed decides, and waits for its end.
void work_until_killed(const fs::path& folder, int first, unsigned seed, SharedDiary& diary) {
    diary->save_begun = diary->saved = diary->autosaved = 0;
    const pid_t child = ::fork();
    if (child == 0) work_for_ever(folder, first, seed, diary);
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (diary->save_begun == 0 && std::chrono::steady_clock::now() < deadline)
        std::this_thread::sleep_for(std::chrono::microseconds(200));
    std::mt19937 random(seed + 1);
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 12'000));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "the child ended by itself";
    EXPECT_GT(diary->save_begun, 0);
}

TEST(Kill, At200RandomMomentsLosesNothing) {
    TemporaryFolder temporary;
    const auto folder = temporary.path() / "a.interreflect";
    save_project(testing::numbered(1), folder, "");
    SharedDiary diary;
    int first = 2, amid_a_save = 0, recoveries = 0;
    for (unsigned round = 0; round < 200; ++round) {
        const int before = first - 1;
        work_until_killed(folder, first, 2 * round, diary);
        const auto found = open_again(folder);  // the dead process's lock is no obstacle
        const int saved = std::max(diary->saved.load(), before);
        EXPECT_TRUE(found.saved == saved || found.saved == diary->save_begun)
            << found.saved << " is neither " << saved << " nor " << diary->save_begun;
        EXPECT_GE(found.newest(), diary->autosaved);
        for (const int state : found.recoverable)
            EXPECT_GT(state, found.saved) << "older than what is saved, and yet offered";
        amid_a_save += diary->save_begun != diary->saved;
        recoveries += !found.recoverable.empty();
        ASSERT_FALSE(HasFailure()) << "round " << round;

        OpenProject open(folder, registry());
        while (open.recovery()) round % 2 ? open.take_recovery() : open.discard_recovery();
        open.save();
        first = std::max(found.newest(), diary->save_begun.load()) + 1;
        testing::edit_to(open, first++);
        open.save();
        open.close();
    }
    // Or the moments would test nothing.
    EXPECT_GT(amid_a_save, 20);
    EXPECT_GT(recoveries, 20);
    RecordProperty("amid_a_save", amid_a_save);
    RecordProperty("recoveries", recoveries);
    // Nothing piles up.
    for (const auto& entry : fs::directory_iterator(folder)) {
        const auto name = entry.path().filename().string();
        EXPECT_TRUE(name.rfind(".lock", 0) != 0 && name.find("recovery") == std::string::npos) << name;
    }
}

}  // namespace
}  // namespace ir::projects
