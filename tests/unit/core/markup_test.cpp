#include "renderers/core/markup.h"

#include <gtest/gtest.h>

namespace ir {
namespace {

TEST(Markup, TextAndAttributesCannotBecomeElements) {
    Markup page;
    page.open("p", {{"title", "\"><script>alert('x')</script>"}}).text("a < b & \"c\"\n'd'").close();
    EXPECT_EQ(page.str(),
              "<p title=\"&quot;&gt;&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;\">a &lt; b &amp; "
              "&quot;c&quot;\n&#39;d&#39;</p>");
}

TEST(Markup, ElementsAreClosedInOrder) {
    Markup page;
    page.open("ul")
        .line("li", "one", {{"", "left out"}, {"class", "x"}})
        .empty("br")
        .open("li")
        .close()
        .close();
    EXPECT_EQ(page.str(), "<ul><li class=\"x\">one</li><br/><li></li></ul>");
}

TEST(Markup, ControlCharactersAreReplaced) {
    EXPECT_EQ(escaped(std::string("a\0b\x1b[1m", 7)), "a\uFFFDb\uFFFD[1m");
    EXPECT_EQ(escaped("a\u009b31m\u202egnp.\u2066exe\u2028"), "a\uFFFD31m\uFFFDgnp.\uFFFDexe\uFFFD");
    EXPECT_EQ(escaped("Grüße – ∞ 日本 🙂\t\n"), "Grüße – ∞ 日本 🙂\t\n");
}

}  // namespace
}  // namespace ir
