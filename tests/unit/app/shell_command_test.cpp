// Completion and the manual's page tell what the commands are.
#include <algorithm>
#include <sstream>

#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

class ShellCommand : public CommandTest {
  protected:
    /// What bash offers for the last of `words`.
    std::vector<std::string> completed(const std::string& words, int index) const {
        const auto script = folder_ / "script", out = folder_ / "offered";
        std::ofstream(script) << output("completion bash") << "COMP_WORDS=(interreflect-cli " << words
                              << ")\nCOMP_CWORD=" << index
                              << "\n_interreflect_cli\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n";
        EXPECT_EQ(std::system(("bash " + script.string() + " >" + out.string()).c_str()), 0);
        std::vector<std::string> lines;
        std::istringstream text(read(out));
        for (std::string line; std::getline(text, line);) lines.push_back(line);
        return lines;
    }
};

TEST_F(ShellCommand, BashCompletesCommandsOptionsAndValues) {
    using Words = std::vector<std::string>;
    EXPECT_EQ(completed("comp", 1), (Words{"compare", "completion"}));
    EXPECT_EQ(completed("render --met", 2), (Words{"--method"}));
    EXPECT_EQ(completed("render --method photon", 3), (Words{"photon-mapping"}));
    const auto scenes = completed("render --scene builtin:c", 3);
    EXPECT_EQ(std::count(scenes.begin(), scenes.end(), "builtin:cornell"), 1);
    std::ofstream(folder_ / "scene.glb");
    EXPECT_EQ(completed("render --scene " + (folder_ / "sc").string(), 3).size(), 2u)
        << "a file, and the script";
}

TEST_F(ShellCommand, EachShellHearsOfEveryCommand) {
    const auto help = output("--help");
    for (const auto* shell : {"bash", "zsh", "fish"}) {
        const auto script = output("completion " + std::string(shell));
        for (const auto* command : {"render", "compare", "rerun", "bench", "manual"})
            EXPECT_NE(script.find(command), std::string::npos) << shell << " " << command;
        EXPECT_NE(script.find("fail-above"), std::string::npos) << shell;
    }
    EXPECT_EQ(run("completion csh").status, 2);
}

TEST_F(ShellCommand, LightsAreExplainedWhateverElseIsMissing) {
    const auto help = output("render --light help");
    for (const auto* part :
         {"point:position=", "rect:position=", "[inner]", "or flux", "W/sr", "--env", "Quote"})
        EXPECT_NE(help.find(part), std::string::npos) << part << "\n" << help;
}

TEST_F(ShellCommand, TheManualHasEveryCommandAndNoRequestByChance) {
    const auto page = output("manual");
    EXPECT_EQ(page.rfind(".TH ", 0), 0u);
    for (const auto* part :
         {".SS render\n", ".SS sweep\n", ".SS sweep merge\n", ".B \\-\\-dump\n", ".SH EXIT STATUS\n"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line[0] != '.') continue;
        const auto request = line.substr(0, line.find(' '));
        EXPECT_TRUE(request == ".TH" || request == ".SH" || request == ".SS" || request == ".TP" ||
                    request == ".B" || request == ".I")
            << line;
    }
}

TEST_F(ShellCommand, StatusesAreThoseOfTheDocumentation) {
    const auto documented = read(fs::path(SOURCE_ROOT) / "docs" / "command-line.md");
    std::istringstream page(output("manual"));
    std::string line, value;
    while (std::getline(page, line) && line != ".SH EXIT STATUS") {
    }
    int statuses = 0;
    while (std::getline(page, line)) {
        if (line.rfind(".B ", 0) == 0) {
            value = line.substr(3);
        } else if (line != ".TP") {
            line.erase(std::remove(line.begin(), line.end(), '\\'), line.end());
            EXPECT_NE(documented.find("| " + value + " | " + line + " |"), std::string::npos) << value;
            ++statuses;
        }
    }
    EXPECT_EQ(statuses, 6);
}

}  // namespace
}  // namespace ir
