#include "projects/note_links.h"

#include <utility>

namespace ir::projects {
namespace {

constexpr std::pair<std::string_view, NotePlace> places[] = {{"view", NotePlace::view},
                                                             {"pin", NotePlace::pin},
                                                             {"parameter", NotePlace::parameter},
                                                             {"buffer", NotePlace::buffer},
                                                             {"experiment", NotePlace::experiment}};
constexpr std::size_t longest_address = 256;  ///< bytes, so that hostile notes are read quickly

}  // namespace

std::optional<NoteLink> note_link(std::string_view address) {
    const auto colon = address.find(':');
    if (colon == std::string_view::npos || colon + 1 == address.size()) return {};
    for (const auto& [word, place] : places) {
        if (word != address.substr(0, colon)) continue;
        const auto name = address.substr(colon + 1);
        const auto slash = place == NotePlace::experiment ? name.find('/') : std::string_view::npos;
        if (slash == std::string_view::npos) return NoteLink{place, std::string(name), {}};
        return NoteLink{place, std::string(name.substr(0, slash)), std::string(name.substr(slash + 1))};
    }
    return {};
}

std::string without_note_links(std::string_view notes) {
    std::string words;
    auto bracket = std::string::npos;  // the last one that opens, in `words`
    for (std::size_t i = 0; i < notes.size(); ++i) {
        if (notes[i] == '[') bracket = words.size();
        if (bracket != std::string::npos && notes.substr(i, 2) == "](") {
            const auto address = notes.substr(i + 2, longest_address);
            const auto end = address.find(')');
            if (end != std::string_view::npos && note_link(address.substr(0, end))) {
                words.erase(std::exchange(bracket, std::string::npos), 1);
                i += 2 + end;
                continue;
            }
        }
        words += notes[i];
    }
    return words;
}

}  // namespace ir::projects
