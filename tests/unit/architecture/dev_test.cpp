// ./dev: what it knows ends well, what it does not know is a wrong use.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <string>

namespace {

struct Outcome {
    int status = 0;
    std::string out;
};

/// Standard output or, with "2>&1 >/dev/null", standard error.
Outcome dev(const std::string& arguments) {
    Outcome outcome;
    auto* pipe = ::popen((SOURCE_ROOT "/dev " + arguments).c_str(), "r");
    char block[4096];
    while (const auto count = std::fread(block, 1, sizeof block, pipe)) outcome.out.append(block, count);
    outcome.status = WEXITSTATUS(::pclose(pipe));
    return outcome;
}

TEST(Dev, HelpIsOnStandardOutputAndEndsWell) {
    const auto help = dev("help 2>/dev/null");
    EXPECT_EQ(help.status, 0);
    EXPECT_NE(help.out.find("./dev test"), std::string::npos);
    for (const char* arguments : {"", "--help", "-h"}) {
        const auto same = dev(std::string(arguments) + " 2>/dev/null");
        EXPECT_EQ(same.status, 0) << arguments;
        EXPECT_EQ(same.out, help.out) << arguments;
    }
}

TEST(Dev, AnUnknownCommandIsAWrongUse) {
    EXPECT_EQ(dev("nonsense 2>/dev/null").out, "");
    const auto complaint = dev("nonsense 2>&1 >/dev/null");
    EXPECT_EQ(complaint.status, 2);
    EXPECT_NE(complaint.out.find("no command 'nonsense'"), std::string::npos) << complaint.out;
    EXPECT_NE(complaint.out.find("./dev test"), std::string::npos) << "the help follows";
}

TEST(Dev, AMethodWithABadNameIsRefusedInOneLine) {
    for (const char* id : {"'My method'", "view-normals", "../away", "a--b", "union", "graph",
                           "ok --title 'a\"b'", "ok --title 'a\tb'", "ok --into /tmp"}) {
        const auto complaint = dev(std::string("method ") + id + " 2>&1 >/dev/null");
        EXPECT_EQ(complaint.status, 2) << id;
        EXPECT_EQ(std::count(complaint.out.begin(), complaint.out.end(), '\n'), 1) << complaint.out;
    }
}

}  // namespace
