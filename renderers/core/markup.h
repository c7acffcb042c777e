#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ir {

/// Writes HTML and SVG. Text and attributes are escaped, and elements are closed in order: whatever names
/// people give to things, they cannot become markup.
class Markup {
  public:
    using Attributes = std::initializer_list<std::pair<std::string_view, std::string_view>>;

    /// An attribute without a name is left out.
    Markup& open(std::string_view element, Attributes attributes = {});
    Markup& close();  ///< the element opened last
    Markup& text(std::string_view text);
    /// An element without content: `<br/>`.
    Markup& empty(std::string_view element, Attributes attributes = {});
    /// An element that holds only text.
    Markup& line(std::string_view element, std::string_view text, Attributes attributes = {});
    /// Markup that was written already, or a style or a script: nothing is escaped.
    Markup& raw(std::string_view markup);

    const std::string& str() const { return out_; }

  private:
    void begin(std::string_view element, Attributes attributes);
    std::string out_;
    std::vector<std::string> open_;
};

/// Fit for text and for attributes in double quotes: & < > " and ' are escaped, control characters that no
/// document may have become U+FFFD.
std::string escaped(std::string_view text);

}  // namespace ir
