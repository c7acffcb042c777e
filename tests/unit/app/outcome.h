#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

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

}  // namespace ir
