#pragma once

#include <optional>
#include <string>
#include <string_view>

/// Links in a project's notes, which are Markdown: "[the left](view:1)" leads to a place in the window.
namespace ir::projects {

enum class NotePlace { view, pin, parameter, buffer, experiment };

/// "view:2", "pin:3", "parameter:KEY", "buffer:KEY", "experiment:ID", "experiment:ID/KEY".
struct NoteLink {
    NotePlace place = NotePlace::view;
    std::string name;    ///< a number from 1 on, a key or an id
    std::string buffer;  ///< of an experiment; empty: its picture
    bool operator==(const NoteLink&) const = default;
};

/// Absent: the address is no such link. Whether there is such a place is not looked at.
std::optional<NoteLink> note_link(std::string_view address);

/// The notes with the words of such links alone, for pages that have no such places.
std::string without_note_links(std::string_view notes);

}  // namespace ir::projects
