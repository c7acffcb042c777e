#include "projects/note_links.h"

#include <gtest/gtest.h>

namespace ir::projects {
namespace {

TEST(NoteLinks, NameAPlace) {
    EXPECT_EQ(note_link("view:2"), (NoteLink{NotePlace::view, "2", ""}));
    EXPECT_EQ(note_link("pin:3"), (NoteLink{NotePlace::pin, "3", ""}));
    EXPECT_EQ(note_link("parameter:max_distance"), (NoteLink{NotePlace::parameter, "max_distance", ""}));
    EXPECT_EQ(note_link("buffer:a/b"), (NoteLink{NotePlace::buffer, "a/b", ""}));
    EXPECT_EQ(note_link("experiment:few"), (NoteLink{NotePlace::experiment, "few", ""}));
    EXPECT_EQ(note_link("experiment:few/depth"), (NoteLink{NotePlace::experiment, "few", "depth"}));
    for (const char* other :
         {"", "view", "view:", ":2", "views:2", "file:///etc/passwd", "https://a.b", "a.md"})
        EXPECT_FALSE(note_link(other)) << other;
}

TEST(NoteLinks, LeaveTheirWordsOnPagesWithoutPlaces) {
    EXPECT_EQ(without_note_links("On the [left](view:1) and [right](view:2)."), "On the left and right.");
    EXPECT_EQ(without_note_links("[8, 9] and [a [pin](pin:1)]"), "[8, 9] and [a pin]");
    for (const char* same : {"", "[a](https://b.c)", "](view:1)", "[a](view:1", "[a] (view:1)", "[a](view:)"})
        EXPECT_EQ(without_note_links(same), same);
    std::string hostile;
    for (int i = 0; i < 200'000; ++i) hostile += "[](view";
    EXPECT_EQ(without_note_links(hostile), hostile);
}

}  // namespace
}  // namespace ir::projects
