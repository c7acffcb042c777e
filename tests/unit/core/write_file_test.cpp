// Files are whole or as they were, whatever the disk does; links, devices and descriptors stay what they are.
#include "renderers/core/write_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <random>
#include <set>
#include <sstream>

#include "renderers/core/error.h"
#include "tests/unit/core/faulty_disk.h"
#include "tests/unit/image/temporary_folder.h"
#include "tests/unit/scarce_disk.h"

namespace ir {
namespace {

namespace fs = std::filesystem;

const std::string old_bytes = "what stood there before", new_bytes = std::string(100'000, 'n');

std::set<std::string> names_in(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
    return names;
}

template <class Work>
std::string error_of(Work work) {
    try {
        work();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

mode_t mode_of(const fs::path& file) {
    struct stat info {};
    EXPECT_EQ(::stat(file.c_str(), &info), 0);
    return info.st_mode & 07777;
}

class WriteFile : public testing::Test {
  protected:
    WriteFile() { write_bytes(file, old_bytes); }

    void expect_refused(const FaultyDisk& faulty, const std::string& part) {
        const auto line = error_of([&] {
            const DiskFault fault(faulty);
            write_file(file, new_bytes);
        });
        EXPECT_EQ(line.rfind(file.string() + ": cannot be written: ", 0), 0u) << line;
        EXPECT_NE(line.find(part), std::string::npos) << line;
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
        EXPECT_EQ(read_bytes(file), old_bytes);
        EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"a.bin"});
    }

    TemporaryFolder folder;
    const fs::path file = folder / "a.bin";
};

TEST_F(WriteFile, ANetworkThatLosesTheAnswerOfWhatItRenamed) {
    const DiskFault fault({.loses_answers = true});
    write_file(file, new_bytes);
    EXPECT_EQ(read_bytes(file), new_bytes);
    EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"a.bin"});
    EXPECT_THROW(real_file_system().rename(folder / "none", file), Error);
    EXPECT_EQ(read_bytes(file), new_bytes);
}

TEST_F(WriteFile, FilesThatAreReplacedMeanwhileAreReadAgain) {
    {
        const DiskFault fault({.stale_reads = 2});
        EXPECT_EQ(real_file_system().read(file, 100), old_bytes);
    }
    const DiskFault fault({.stale_reads = 1000});
    const auto line = error_of([&] { real_file_system().read(file, 100); });
    EXPECT_EQ(line.rfind(file.string() + ": cannot read: ", 0), 0u) << line;
}

TEST_F(WriteFile, WhatANetworkKeepsUntilItIsClosedIsNotListed) {
    write_bytes(folder / ".nfs0000000000000123", "removed");
    EXPECT_EQ(real_file_system().list(folder.path()), std::vector<fs::path>{"a.bin"});
}

TEST_F(WriteFile, ADiskThatIsFullSoonerOrLater) {
    for (std::int64_t room = 0; room < std::int64_t(new_bytes.size()); room += 999)
        expect_refused({.room = room}, "free some space");
    expect_refused({.room = std::int64_t(new_bytes.size()) - 1}, "free some space");
}

TEST_F(WriteFile, DisksThatReportOnlyWhenTheySyncOrClose) {
    expect_refused({.fails_to_sync = true}, "check the disk");
    expect_refused({.fails_to_close = true}, "free some space");
    expect_refused({.loses_bytes = true}, "check the disk");
}

TEST_F(WriteFile, ADiskThatTakesLittleAtOnceGetsEverything) {
    const DiskFault fault({.max_at_once = 777, .interrupts = true});
    write_file(file, new_bytes);
    EXPECT_EQ(read_bytes(file), new_bytes);
}

TEST_F(WriteFile, EveryRoomForWhatIsSmallerThanAPage) {
    const auto ordeal = [](std::size_t size) {
        return Ordeal{[](const fs::path& disk) { write_bytes(disk / "a", old_bytes); },
                      [size](const fs::path& disk) { write_file(disk / "a", std::string(size, 'n')); },
                      [size](const fs::path& disk, bool done) -> std::string {
                          const auto now = read_bytes(disk / "a");
                          return now == (done ? std::string(size, 'n') : old_bytes) ? ""
                                                                                    : "neither old nor new";
                      }};
    };
    fs::create_directories(folder / "disk");
    for (const std::size_t size : {1, 100, 4095, 4096, 4097, 20'000}) {
        EXPECT_EQ(with_small_files(folder / "disk", ordeal(size), (size + 9) / 10), "ok") << size;
        const auto answer = with_few_pages(folder / "disk", ordeal(size));
        if (answer == "not allowed") GTEST_SKIP() << "may not mount; files of limited size went well";
        EXPECT_EQ(answer, "ok") << size;
    }
}

TEST_F(WriteFile, WhatCannotBeFilledLeavesNothing) {
    EXPECT_EQ(error_of([&] { write_file(file, [](std::ostream&) { throw Error("not this"); }); }),
              "not this");
    EXPECT_THROW(write_file(file,
                            [](std::ostream& out) {
                                out << "a part";
                                throw Cancelled();
                            }),
                 Cancelled);
    EXPECT_EQ(read_bytes(file), old_bytes);
    EXPECT_EQ(names_in(folder.path()), std::set<std::string>{"a.bin"});
}

/// Whoever finds one after a crash sees what it is; none is in the way of the next.
TEST_F(WriteFile, TemporariesHaveAnEndingOfTheirOwn) {
    for (int i = 0; i < 2; ++i)
        write_file(file, [&](std::ostream& out) {
            auto names = names_in(folder.path());
            EXPECT_EQ(names.erase("a.bin"), 1u);
            ASSERT_EQ(names.size(), 1u);
            EXPECT_EQ(names.begin()->rfind("a.bin.", 0), 0u) << *names.begin();
            EXPECT_TRUE(names.begin()->ends_with(temporary_extension)) << *names.begin();
            out << new_bytes;
        });
    // Where processes have the same number again and again, as in containers.
    const auto next = [&] {
        std::string name;
        write_file(file, [&](std::ostream&) {
            for (const auto& each : names_in(folder.path()))
                if (each.ends_with(temporary_extension)) name = each;
        });
        const auto dash = name.rfind('-');
        return name.substr(0, dash + 1) + std::to_string(std::stoi(name.substr(dash + 1)) + 1) + ".tmp";
    }();
    write_bytes(folder / next, "left by another");
    write_file(file, new_bytes);
    EXPECT_EQ(read_bytes(file), new_bytes);
    EXPECT_EQ(read_bytes(folder / next), "left by another");
}

TEST_F(WriteFile, GoesBehindLinks) {
    fs::create_directories(folder / "there");
    fs::create_symlink("a.bin", folder / "one");
    fs::create_symlink("../one", folder / "there/two");
    fs::create_symlink(folder / "there/new.bin", folder / "dangling");
    write_file(folder / "there/two", new_bytes);
    EXPECT_EQ(read_bytes(file), new_bytes);
    write_file(folder / "dangling", "new");
    EXPECT_EQ(read_bytes(folder / "there/new.bin"), "new");
    for (const char* link : {"one", "there/two", "dangling"})
        EXPECT_TRUE(fs::is_symlink(folder / link)) << link;
    EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"a.bin", "dangling", "one", "there"}));
    EXPECT_EQ(names_in(folder / "there"), (std::set<std::string>{"new.bin", "two"}));
    EXPECT_EQ(behind_links(folder / "there/two").lexically_normal(), file);
}

TEST_F(WriteFile, RefusesLinksThatLeadNowhere) {
    fs::create_symlink("circle", folder / "circle");
    fs::create_symlink("none/a.bin", folder / "nowhere");
    fs::create_symlink(".", folder / "folder");
    for (const char* link : {"circle", "nowhere", "folder"}) {
        const auto line = error_of([&] { write_file(folder / link, "x"); });
        EXPECT_NE(line.find("cannot be written"), std::string::npos) << link << ": " << line;
        EXPECT_TRUE(fs::is_symlink(folder / link)) << link;
    }
    EXPECT_EQ(names_in(folder.path()), (std::set<std::string>{"a.bin", "circle", "folder", "nowhere"}));
}

TEST_F(WriteFile, ALinkInAProjectIsReplaced) {
    fs::create_symlink("a.bin", folder / "link");
    write_atomically(real_file_system(), folder / "link", "new");
    EXPECT_EQ(read_bytes(file), old_bytes);
    EXPECT_FALSE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(read_bytes(folder / "link"), "new");
}

TEST_F(WriteFile, KeepsPermissions) {
    const mode_t before = ::umask(022);
    for (const mode_t mode : {0600, 0640, 0664, 0755, 0777}) {
        ::chmod(file.c_str(), mode);
        write_file(file, [&](std::ostream& out) {
            for (const auto& name : names_in(folder.path()))
                EXPECT_EQ(mode_of(folder / name) & ~mode, 0u) << "others could read " << name;
            out << "new";
        });
        EXPECT_EQ(mode_of(file), mode);
    }
    write_file(folder / "b.bin", "new");
    EXPECT_EQ(mode_of(folder / "b.bin"), 0644u);
    ::umask(027);
    write_file(folder / "c.bin", "new");
    EXPECT_EQ(mode_of(folder / "c.bin"), 0640u);
    ::umask(before);
}

TEST_F(WriteFile, WorksWithoutAFolderInTheName) {
    const auto before = fs::current_path();
    fs::current_path(folder.path());
    write_file("a.bin", "new");
    fs::current_path(before);
    EXPECT_EQ(read_bytes(file), "new");
}

TEST_F(WriteFile, APipeGetsTheBytes) {
    const auto pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const int end = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    write_file(pipe, [](std::ostream& out) {
        out << "XX bytes";
        out.seekp(0);
        out << "12";
    });
    char bytes[16] = {};
    EXPECT_EQ(::read(end, bytes, sizeof bytes), 8);
    EXPECT_STREQ(bytes, "12 bytes");
    ::close(end);
    EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(WriteFile, DevicesStayDevices) {
    // The superuser could harm the machine's own; anybody else cannot.
    std::string null = "/dev/null", full = "/dev/full";
    if (::geteuid() == 0) {
        null = folder / "null", full = folder / "full";
        ASSERT_EQ(::mknod(null.c_str(), S_IFCHR | 0666, makedev(1, 3)), 0);
        ASSERT_EQ(::mknod(full.c_str(), S_IFCHR | 0666, makedev(1, 7)), 0);
    }
    fs::create_symlink(null, folder / "link");
    write_file(folder / "link", new_bytes);
    const auto line = error_of([&] { write_file(full, "x"); });
    EXPECT_NE(line.find("free some space"), std::string::npos) << line;
    EXPECT_TRUE(fs::is_character_file(null));
    EXPECT_TRUE(fs::is_character_file(full));
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
}

/// As /dev/stdout is one: with what was printed before, and what follows.
TEST_F(WriteFile, ADescriptorGoesOnWhereItIs) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_TRUNC);
    ASSERT_EQ(::write(descriptor, "before, ", 8), 8);
    write_file("/dev/fd/" + std::to_string(descriptor), "the file, ");
    ASSERT_EQ(::write(descriptor, "after", 5), 5);
    ::close(descriptor);
    EXPECT_EQ(read_bytes(file), "before, the file, after");
}

/// Formats that come back to fill in where their parts begin.
TEST_F(WriteFile, SeeksAsAnyStreamDoes) {
    std::mt19937 random(1);
    const auto number = [&](std::size_t end) { return random() % end; };
    for (int round = 0; round < 20; ++round) {
        std::ostringstream expected;
        write_file(file, [&](std::ostream& out) {
            for (int i = 0; i < 50; ++i) {
                const std::string bytes(number(3) ? number(200) : number(150'000), char('a' + number(26)));
                out << bytes;
                expected << bytes;
                ASSERT_EQ(out.tellp(), expected.tellp());
                if (number(3)) continue;
                const auto place = std::streamoff(number(std::size_t(expected.tellp()) + 1));
                out.seekp(place);
                expected.seekp(place);
                out.put('x');
                expected.put('x');
                out.seekp(0, std::ios::end);
                expected.seekp(0, std::ios::end);
                ASSERT_EQ(out.tellp(), expected.tellp());
            }
        });
        ASSERT_EQ(read_bytes(file), expected.str());
    }
}

}  // namespace
}  // namespace ir
