#pragma once

#include <cstddef>
#include <string_view>

namespace ir {

/// The character that a text in UTF-8 begins with.
struct Character {
    std::size_t bytes = 1;
    /// Not seen but obeyed, by terminals, labels and pages: controls, ends of lines and of paragraphs, and
    /// marks that turn the order of letters.
    bool is_control = false;
};
Character first_character(std::string_view text);  ///< which is not empty

}  // namespace ir
