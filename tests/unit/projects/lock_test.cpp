#include "projects/lock.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

#include "tests/unit/projects/sample.h"

namespace {

/// As a network may.
bool loses_answers = false;

}  // namespace

extern "C" {

int __real_link(const char* from, const char* to);
int __real_unlink(const char* file);

// The linker puts these between (--wrap).

int __wrap_link(const char* from, const char* to) {
    const int linked = __real_link(from, to);
    if (linked != 0 || !loses_answers) return linked;
    errno = EEXIST;
    return -1;
}

int __wrap_unlink(const char* file) {
    const int unlinked = __real_unlink(file);
    if (unlinked != 0 || !loses_answers) return unlinked;
    errno = ENOENT;
    return -1;
}

}  // extern "C"

namespace ir::projects {
namespace {

using testing::TemporaryFolder;

std::string this_host() {
    char name[256] = {};
    ::gethostname(name, sizeof name - 1);
    return name;
}

std::string lock_text(const std::string& host, std::int64_t pid, std::uint64_t started) {
    return pretty_json(Json{{"host", host}, {"pid", pid}, {"started", started}, {"since", "yesterday"}});
}

/// Runs in a child process; true when it returned true.
template <class Run>
bool in_child(Run run) {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(run() ? 0 : 1);
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(Lock, OneWriterAtATime) {
    TemporaryFolder folder;
    auto first = Lock::acquire(folder.path());
    EXPECT_TRUE(first.is_held());
    EXPECT_TRUE(first.is_still_ours());
    const auto second = Lock::acquire(folder.path());
    EXPECT_FALSE(second.is_held());
    ASSERT_TRUE(second.holder());
    EXPECT_EQ(second.holder()->pid, ::getpid());
    EXPECT_NE(second.reason().find("read-only"), std::string::npos);
    EXPECT_NE(second.reason().find(std::to_string(::getpid())), std::string::npos);
    EXPECT_TRUE(in_child([&] { return !Lock::acquire(folder.path()).is_held(); }));
    first.release();
    EXPECT_TRUE(in_child([&] { return Lock::acquire(folder.path()).is_held(); }));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / ".lock.tmp"));
}

TEST(Lock, ANetworkMayLoseTheAnswer) {
    TemporaryFolder folder;
    loses_answers = true;
    auto first = Lock::acquire(folder.path());
    EXPECT_TRUE(first.is_held());
    EXPECT_FALSE(Lock::acquire(folder.path()).is_held());
    first.release();
    EXPECT_TRUE(Lock::acquire(folder.path()).is_held());
    EXPECT_TRUE(in_child([&] { return (new Lock(Lock::acquire(folder.path())))->is_held(); }))
        << "and crashes";
    EXPECT_TRUE(Lock::acquire(folder.path()).is_held()) << "of one who is gone";
    loses_answers = false;
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Lock, TwoUsersRespectEachOther) {
    if (::getuid() != 0) GTEST_SKIP() << "only root can be two users";
    TemporaryFolder folder;
    constexpr uid_t one = 65001, other = 65002;
    const auto takes_as = [&](uid_t user) {
        return in_child([&] {
            if (::setuid(user) != 0) return false;
            const auto* lock = new Lock(Lock::acquire(folder.path()));  // not given back, as by a crash
            return lock->is_held();
        });
    };
    EXPECT_FALSE(takes_as(one)) << "may not write there";
    ::chmod(folder.path().c_str(), 0777);
    {
        const auto held = Lock::acquire(folder.path());
        EXPECT_FALSE(takes_as(one)) << "of a process that he may not even signal";
    }
    EXPECT_TRUE(takes_as(one));
    EXPECT_TRUE(takes_as(other)) << "of one who is gone";
}

TEST(Lock, MovesWithItsOwnerAndEndsWithIt) {
    TemporaryFolder folder;
    {
        auto lock = Lock::acquire(folder.path());
        const Lock moved = std::move(lock);
        EXPECT_TRUE(moved.is_held());
        EXPECT_FALSE(lock.is_held());
    }
    EXPECT_FALSE(std::filesystem::exists(folder.path() / ".lock"));
}

TEST(Lock, OfADeadProcessIsTakenOver) {
    TemporaryFolder folder;
    // The child ends without giving the lock back, as a crash does.
    EXPECT_TRUE(in_child([&] {
        auto* lock = new Lock(Lock::acquire(folder.path()));
        return lock->is_held();
    }));
    EXPECT_TRUE(std::filesystem::exists(folder.path() / ".lock"));
    EXPECT_TRUE(Lock::acquire(folder.path()).is_held());
}

TEST(Lock, OfAZombieIsTakenOver) {
    TemporaryFolder folder;
    const pid_t child = ::fork();
    if (child == 0) {
        new Lock(Lock::acquire(folder.path()));
        ::_exit(0);
    }
    siginfo_t info{};
    ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT);  // ended, but not yet reaped
    EXPECT_TRUE(Lock::acquire(folder.path()).is_held());
    ::waitpid(child, nullptr, 0);
}

TEST(Lock, OfAReusedPidIsTakenOver) {
    TemporaryFolder folder;
    testing::write_text(folder.path() / ".lock", lock_text(this_host(), ::getpid(), 1));
    EXPECT_TRUE(Lock::acquire(folder.path()).is_held());
}

TEST(Lock, OfAnotherHostIsNeverTakenSilently) {
    TemporaryFolder folder;
    testing::write_text(folder.path() / ".lock", lock_text("elsewhere", 1 << 30, 5));
    const auto lock = Lock::acquire(folder.path());
    EXPECT_FALSE(lock.is_held());
    EXPECT_NE(lock.reason().find("elsewhere"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(folder.path() / ".lock"));
    const auto broken = Lock::break_and_acquire(folder.path());
    EXPECT_TRUE(broken.is_held());
}

TEST(Lock, ThatWasBrokenIsNotGivenBack) {
    TemporaryFolder folder;
    auto lock = Lock::acquire(folder.path());
    const auto other = lock_text("elsewhere", 5, 5);
    testing::write_text(folder.path() / ".lock", other);
    EXPECT_FALSE(lock.is_still_ours());
    lock.release();
    EXPECT_EQ(testing::read_text(folder.path() / ".lock"), other);
}

TEST(Lock, DamagedIsRespectedAndSaysHowToMendIt) {
    TemporaryFolder folder;
    testing::write_text(folder.path() / ".lock", "garbage");
    const auto lock = Lock::acquire(folder.path());
    EXPECT_FALSE(lock.is_held());
    EXPECT_NE(lock.reason().find("delete it"), std::string::npos);
}

TEST(Lock, UnwritableFolderOpensReadOnly) {
    const auto lock = Lock::acquire("/proc/self");
    EXPECT_FALSE(lock.is_held());
    EXPECT_NE(lock.reason().find("cannot be written"), std::string::npos);
}

/// Eight processes take the lock at once and stay alive. Returns how many got it.
int count_winners(const std::filesystem::path& folder) {
    constexpr int takers = 8;
    int ready[2], answers[2];
    if (::pipe(ready) != 0 || ::pipe(answers) != 0) return -1;
    std::vector<pid_t> children;
    for (int i = 0; i < takers; ++i) {
        const pid_t child = ::fork();
        if (child == 0) {
            ::close(ready[1]);
            char go;
            while (::read(ready[0], &go, 1) > 0) {
            }
            auto* lock = new Lock(Lock::acquire(folder));
            const char answer = lock->is_held() ? '1' : '0';
            if (::write(answers[1], &answer, 1) != 1) ::_exit(1);
            while (true) ::pause();  // stays alive, so that its lock is no stale one
        }
        children.push_back(child);
    }
    ::close(ready[1]);  // all start at once
    int winners = 0;
    for (int i = 0; i < takers; ++i) {
        char answer = '?';
        if (::read(answers[0], &answer, 1) != 1) winners = -takers;
        winners += answer == '1';
    }
    for (const pid_t child : children) {
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
    }
    for (const int end : {ready[0], answers[0], answers[1]}) ::close(end);
    return winners;
}

TEST(Lock, ManyTakersOfAStaleLockYieldOneWinner) {
    for (int round = 0; round < 40; ++round) {
        TemporaryFolder folder;
        testing::write_text(folder.path() / ".lock", lock_text(this_host(), ::getpid(), 1));
        ASSERT_EQ(count_winners(folder.path()), 1) << "round " << round;
    }
}

}  // namespace
}  // namespace ir::projects
