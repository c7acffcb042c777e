#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/own_folder.h"

namespace ir {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

inline std::string read(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// What a run of a program left.
struct Outcome {
    int status = 0;
    std::string out, err;
};

/// Runs interreflect-cli with `arguments`; what it prints goes through files in `folder`.
inline Outcome run_program(const std::string& arguments, const fs::path& folder) {
    const auto out = folder / "stdout", err = folder / "stderr";
    const auto command =
        std::string(CLI_PROGRAM) + " " + arguments + " >" + out.string() + " 2>" + err.string();
    const int status = std::system(command.c_str());
    EXPECT_TRUE(WIFEXITED(status)) << command;
    return {WEXITSTATUS(status), read(out), read(err)};
}

/// Runs of the program in a folder of the test's own.
class CommandTest : public testing::Test {
  protected:
    void SetUp() override {
        const auto& test = *testing::UnitTest::GetInstance()->current_test_info();
        folder_ = own_folder(std::string(test.test_suite_name()) + "-" + test.name());
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string file(const std::string& name) const { return (folder_ / name).string(); }
    Outcome run(const std::string& arguments) const { return run_program(arguments, folder_); }
    /// What it prints.
    std::string output(const std::string& arguments) const {
        const auto outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << arguments << "\n" << outcome.err;
        return outcome.out;
    }
    /// In one line that holds `part`.
    void expect_refused(const std::string& arguments, int status, const std::string& part) const {
        const auto outcome = run(arguments);
        EXPECT_EQ(outcome.status, status) << arguments << "\n" << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    }

    fs::path folder_;
};

}  // namespace ir
