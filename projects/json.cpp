#include "projects/json.h"

#include <algorithm>
#include <unordered_set>

#include "projects/json_events.h"
#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/value.h"

namespace ir::projects {
namespace {

std::string line_and_column(std::string_view text, std::size_t byte) {
    const auto before = text.substr(0, std::min(byte == 0 ? 0 : byte - 1, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const auto newline = before.rfind('\n');
    const auto column = before.size() - (newline == std::string_view::npos ? 0 : newline + 1) + 1;
    return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

/// Nesting is measured on the bytes before anything is built.
void check_depth(std::string_view text, const std::string& file, std::size_t deepest) {
    std::size_t depth = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\')
                ++i;
            else if (c == '"')
                in_string = false;
        } else if (c == '"') {
            in_string = true;
        } else if (c == '[' || c == '{') {
            if (++depth > deepest)
                throw InputError(file, line_and_column(text, i + 1),
                                 "nested deeper than " + std::to_string(deepest) + " levels; flatten it");
        } else if ((c == ']' || c == '}') && depth > 0) {
            --depth;
        }
    }
}

/// Refuses duplicate keys, which a tree would lose, and objects so large that ordered look-up gets slow.
class KeyGuard final : public JsonEvents {
  public:
    KeyGuard(const std::string& file, std::size_t most) : file_(file), max_(most) {}

    bool start_object(std::size_t) override {
        open_.emplace_back();
        return true;
    }
    bool end_object() override {
        open_.pop_back();
        return true;
    }
    bool key(string_t& key) override {
        if (!open_.back().insert(key).second)
            throw InputError(file_, "key '" + printable(key) + "'", "stands twice in one object; remove one");
        if (open_.back().size() > max_)
            throw InputError(file_, "key '" + printable(key) + "'",
                             "one object has more than " + std::to_string(max_) + " keys; remove some");
        return true;
    }

  private:
    const std::string& file_;
    std::size_t max_;
    std::vector<std::unordered_set<std::string>> open_;
};

std::string short_reason(const std::string& what) {
    auto reason = what.substr(std::min(what.size(), what.find("] ") + 2));
    if (const auto colon = reason.find(": "); colon != std::string::npos) reason = reason.substr(colon + 2);
    const auto last_read = reason.find("last read: ");
    const auto after = last_read == std::string::npos ? last_read : reason.rfind("; expected");
    std::string expected = after != std::string::npos && after > last_read ? reason.substr(after) : "";
    if (last_read != std::string::npos) reason = reason.substr(0, last_read);
    while (!reason.empty() && (reason.back() == ' ' || reason.back() == ';')) reason.pop_back();
    return printable(reason + expected);
}

std::string number_text(double number) {
    auto result = shortest_text(number);
    if (result.find_first_of(".en") == std::string::npos) result += ".0";  // n: "inf" and "nan" stay visible
    return result;
}

std::string scalar_text(const Json& json) {
    if (json.is_number_float()) return number_text(json.get<double>());
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

bool fits_one_line(const Json& array) {
    return std::all_of(array.begin(), array.end(), [](const Json& item) { return item.is_number(); });
}

void append_pretty(std::string& out, const Json& json, std::size_t indent);

void append_members(std::string& out, const Json& json, std::size_t indent) {
    const std::string margin(indent + 2, ' ');
    const char* separator = "\n";
    for (auto it = json.begin(); it != json.end(); ++it) {
        out.append(separator).append(margin);
        if (json.is_object()) out.append(scalar_text(Json(it.key()))).append(": ");
        append_pretty(out, *it, indent + 2);
        separator = ",\n";
    }
    out += "\n" + std::string(indent, ' ');
}

void append_pretty(std::string& out, const Json& json, std::size_t indent) {
    if (!json.is_structured()) {
        out += scalar_text(json);
    } else if (json.empty()) {
        out += json.is_array() ? "[]" : "{}";
    } else if (json.is_array() && fits_one_line(json)) {
        for (std::size_t i = 0; i < json.size(); ++i)
            out.append(i == 0 ? "[" : ", ").append(scalar_text(json[i]));
        out += "]";
    } else {
        out += json.is_array() ? '[' : '{';
        append_members(out, json, indent);
        out += json.is_array() ? ']' : '}';
    }
}

void append_canonical(std::string& out, const Json& json) {
    if (json.is_object()) {
        std::vector<Json::const_iterator> members;
        for (auto it = json.begin(); it != json.end(); ++it) members.push_back(it);
        std::sort(members.begin(), members.end(),
                  [](const auto& a, const auto& b) { return a.key() < b.key(); });
        out += '{';
        for (std::size_t i = 0; i < members.size(); ++i) {
            out.append(i == 0 ? "" : ",").append(scalar_text(Json(members[i].key()))).append(":");
            append_canonical(out, *members[i]);
        }
        out += '}';
    } else if (json.is_array()) {
        out += '[';
        for (std::size_t i = 0; i < json.size(); ++i) {
            if (i > 0) out += ',';
            append_canonical(out, json[i]);
        }
        out += ']';
    } else {
        out += scalar_text(json);
    }
}

}  // namespace

Json parse_json(std::string_view text, const std::string& file, const JsonLimits& limits) {
    if (text.size() > limits.bytes)
        throw InputError(file, "",
                         "has " + std::to_string(text.size()) + " bytes, more than the " +
                             std::to_string(limits.bytes) + " that are read; it is no such file");
    check_depth(text, file, limits.depth);
    try {
        KeyGuard guard(file, limits.keys_per_object);
        Json::sax_parse(text.begin(), text.end(), &guard);  // what is no JSON, the next line says
        return Json::parse(text.begin(), text.end());
    } catch (const Json::parse_error& error) {
        throw InputError(file, line_and_column(text, error.byte),
                         "not JSON (" + short_reason(error.what()) + "); mend it or restore a copy");
    } catch (const Json::exception&) {
        throw InputError(file, "", "contains a number beyond the range of double precision; give another");
    }
}

std::string pretty_json(const Json& json) {
    std::string out;
    append_pretty(out, json, 0);
    return out + "\n";
}

std::string canonical_json(const Json& json) {
    std::string out;
    append_canonical(out, json);
    return out;
}

}  // namespace ir::projects
