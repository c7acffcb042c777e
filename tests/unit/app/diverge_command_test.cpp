// `interreflect-cli diverge`: two processors, one picture.
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

class DivergeCommand : public CommandTest {
  protected:
    static std::string command(const std::string& flags) {
        return "diverge hbao --size 32x24 --quiet " + flags;
    }
};

TEST_F(DivergeCommand, NamesTheFirstBufferThatDiffers) {
    const auto same = output(command("--tolerance 0.01 --share 0.02"));
    EXPECT_NE(same.find("no buffer that both have diverges"), std::string::npos) << same;
    EXPECT_NE(same.find("gbuffer.position"), std::string::npos) << same;
    EXPECT_EQ(same.find("scene.positions"), std::string::npos) << "the same to the bit: counted\n" << same;
    EXPECT_NE(same.find("are the same to the bit"), std::string::npos) << same;
    const auto strict = run(command("--tolerance 0 --absolute 0 --share 0"));
    EXPECT_EQ(strict.status, 4);
    EXPECT_NE(strict.out.find("the first that diverges is "), std::string::npos) << strict.out;
    const auto json = Json::parse(run(command("--tolerance 0 --share 0 --json")).out);
    EXPECT_TRUE(json["first"].is_string());
    EXPECT_NE(json["a"], json["b"]);
}

TEST_F(DivergeCommand, AMachineAgreesWithItself) {
    const auto text = output(command("--a host --b host --tolerance 0 --absolute 0 --share 0 --all"));
    EXPECT_NE(text.find("no buffer that both have diverges"), std::string::npos) << text;
    EXPECT_NE(text.find("scene.positions"), std::string::npos) << text;
}

TEST_F(DivergeCommand, RefusesOtherWords) {
    expect_refused(command("--a cuda"), 2, "--a 'cuda': give gl or host, egl or osmesa");
    expect_refused(command("--share 2"), 2, "--share");
}

}  // namespace
}  // namespace ir
