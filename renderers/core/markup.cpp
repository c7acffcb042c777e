#include "renderers/core/markup.h"

#include "renderers/core/first_character.h"

namespace ir {

std::string escaped(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    for (std::size_t at = 0; at < text.size();) {
        const auto [bytes, is_control] = first_character(text.substr(at));
        switch (const char c = text[at]) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\'':
                result += "&#39;";
                break;
            case '\n':
            case '\t':
                result += c;
                break;
            default:
                result += is_control ? "\uFFFD" : text.substr(at, bytes);
        }
        at += bytes;
    }
    return result;
}

void Markup::begin(std::string_view element, Attributes attributes) {
    out_ += '<';
    out_ += element;
    for (const auto& [name, value] : attributes)
        if (!name.empty()) ((((out_ += ' ') += name) += "=\"") += escaped(value)) += '"';
}

Markup& Markup::open(std::string_view element, Attributes attributes) {
    begin(element, attributes);
    out_ += '>';
    open_.emplace_back(element);
    return *this;
}

Markup& Markup::close() {
    ((out_ += "</") += open_.back()) += '>';
    open_.pop_back();
    return *this;
}

Markup& Markup::text(std::string_view text) {
    out_ += escaped(text);
    return *this;
}

Markup& Markup::empty(std::string_view element, Attributes attributes) {
    begin(element, attributes);
    out_ += "/>";
    return *this;
}

Markup& Markup::line(std::string_view element, std::string_view text, Attributes attributes) {
    return open(element, attributes).text(text).close();
}

Markup& Markup::raw(std::string_view markup) {
    out_ += markup;
    return *this;
}

}  // namespace ir
