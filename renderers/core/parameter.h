#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "renderers/core/condition.h"
#include "renderers/core/value.h"

namespace ir {

enum class ParameterType { toggle, integer, number, choice };

/// Whether a parameter changes the picture or only what the picture costs.
enum class Effect { image, cost };

/// What a change of the parameter asks of a running execution.
enum class OnChange { nothing, reset_history, reallocate, recompile };

struct Choice {
    std::string key, label, doc;
    /// cost: one of several ways to the same picture, though other choices of the parameter change it.
    Effect effect = Effect::image;
};

/// Closed interval of a numeric parameter; infinite where not given.
struct Range {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
};

/// What one writes about a parameter in a method's describe function; type and default come from the bound
/// member.
struct ParameterText {
    std::string key;                   ///< "max_distance": the name in files, on the command line and in GLSL
    std::string label;                 ///< "Maximum distance"
    std::string doc;                   ///< one or two sentences for tooltip and manual
    std::string unit = {};             ///< "m", "texels", "degrees"; empty for pure numbers
    std::string citation = {};         ///< "Aalund15 §3.2"; keys stand in REFERENCES.bib
    Range hard = {};                   ///< values outside are refused
    Range soft = {};                   ///< what a slider spans
    std::vector<Choice> choices = {};  ///< in the order of the bound enum's values
    std::vector<std::string> supported = {};  ///< keys of the choices that may be taken; empty: all
    /// Keys of the choices that put something exact in the place of an approximation, from the one that
    /// replaces least: an error waterfall puts them in one after another.
    std::vector<std::string> exact = {};
    Effect effect = Effect::image;
    OnChange on_change = OnChange::reset_history;
    Condition active_when = {};
    /// More of it continues the same picture, less is contained in it: what a method accumulates over its
    /// history. An integer: each frame adds so many, and never more than FrameInputs::sample_limit. The
    /// picture depends on their sum, bit by bit, and not on how frames divided it, so that a stored state
    /// (graph::History) serves all values.
    bool accumulates = false;
    /// What it is worth in a coarse picture, which is shown while the full one is rendered and counts for
    /// nothing: of numbers the most, of others the value itself. Absent: what was asked for.
    std::optional<Value> coarse = {};
    int since_version = 1;  ///< the method version that introduced the parameter, or its present default
    std::optional<Value> value_in_older_projects = {};  ///< for projects saved before since_version
};

/// A parameter as everything outside the method sees it: panel, project file, command line, manual, tests.
struct ParameterDescription : ParameterText {
    ParameterType type = ParameterType::toggle;
    Value default_value;

    /// Throws UsageError with one line (key, given value, what is allowed).
    Value checked(const Value& value) const;
    /// Parses text as given on a command line; throws UsageError.
    Value parse(std::string_view text) const;
    /// Index of a choice value; throws UsageError for an unknown key.
    int choice_index(const std::string& choice_key) const;
};

const ParameterDescription* find(const std::vector<ParameterDescription>& parameters, std::string_view key);
/// Throws UsageError that lists the known keys.
const ParameterDescription& parameter_named(const std::vector<ParameterDescription>& parameters,
                                            const std::string& key);

/// Defaults of all parameters.
Settings defaults(const std::vector<ParameterDescription>& parameters);

/// `given` checked and completed with defaults. Unknown keys throw UsageError that lists the known ones.
Settings completed(const std::vector<ParameterDescription>& parameters, const Settings& given);

/// Of complete settings: those of a coarse picture.
Settings coarse(const std::vector<ParameterDescription>& parameters, Settings settings);

/// Whether the parameter has a meaning under these (complete) settings.
bool is_active(const ParameterDescription& parameter, const Settings& settings);

/// Binds the members of a plain struct, whose member initialisers are the only place for defaults, to
/// descriptions. Members may be bool, int, float, double or an enum whose values count from 0.
template <class Struct>
class ParameterTable {
  public:
    /// `member` may be one of a base of the struct.
    template <class Member, class Owner>
    ParameterTable& add(Member Owner::*member, ParameterText text) {
        return add_accessor<Member>([member](Struct& s) -> Member& { return s.*member; }, std::move(text));
    }

    /// Adds all parameters of a nested group, such as the transport.
    template <class Group>
    ParameterTable& include(Group Struct::*group, const ParameterTable<Group>& table) {
        for (const auto& inner : table.entries()) {
            Entry entry{inner.description, nullptr, nullptr};
            entry.read = [group, read = inner.read](const Struct& s) { return read(s.*group); };
            entry.write = [group, write = inner.write](Struct& s, const Value& v) { write(s.*group, v); };
            entry.description.default_value = entry.read(Struct{});
            entries_.push_back(std::move(entry));
        }
        return *this;
    }

    /// Keeps the entries named in `keys`, and restricts the choices of `choice_key` to `supported`.
    ParameterTable only(const std::vector<std::string>& keys, const std::string& choice_key,
                        const std::vector<std::string>& supported) const {
        ParameterTable result;
        for (auto entry : entries_) {
            if (std::find(keys.begin(), keys.end(), entry.description.key) == keys.end()) continue;
            if (entry.description.key == choice_key) entry.description.supported = supported;
            result.entries_.push_back(std::move(entry));
        }
        return result;
    }

    std::vector<ParameterDescription> descriptions() const {
        std::vector<ParameterDescription> result;
        for (const auto& entry : entries_) result.push_back(entry.description);
        return result;
    }

    /// Complete settings to the typed struct. Throws UsageError for bad values.
    Struct typed(const Settings& settings) const {
        Struct result;
        for (const auto& entry : entries_) {
            const auto found = settings.find(entry.description.key);
            if (found != settings.end()) entry.write(result, entry.description.checked(found->second));
        }
        return result;
    }

    Settings settings(const Struct& values) const {
        Settings result;
        for (const auto& entry : entries_) result[entry.description.key] = entry.read(values);
        return result;
    }

    struct Entry {
        ParameterDescription description;
        std::function<Value(const Struct&)> read;
        std::function<void(Struct&, const Value&)> write;
    };
    const std::vector<Entry>& entries() const { return entries_; }

  private:
    template <class Member, class Access>
    ParameterTable& add_accessor(Access access, ParameterText text) {
        Entry entry;
        static_cast<ParameterText&>(entry.description) = std::move(text);
        auto& d = entry.description;
        if constexpr (std::is_same_v<Member, bool>) {
            d.type = ParameterType::toggle;
            entry.read = [access](const Struct& s) -> Value { return access(const_cast<Struct&>(s)); };
            entry.write = [access](Struct& s, const Value& v) { access(s) = std::get<bool>(v); };
        } else if constexpr (std::is_enum_v<Member>) {
            d.type = ParameterType::choice;
            entry.read = [access, choices = d.choices](const Struct& s) -> Value {
                return choices.at(static_cast<std::size_t>(access(const_cast<Struct&>(s)))).key;
            };
            entry.write = [access, d](Struct& s, const Value& v) {
                access(s) = static_cast<Member>(d.choice_index(std::get<std::string>(v)));
            };
        } else if constexpr (std::is_integral_v<Member>) {
            d.type = ParameterType::integer;
            entry.read = [access](const Struct& s) -> Value {
                return static_cast<std::int64_t>(access(const_cast<Struct&>(s)));
            };
            entry.write = [access](Struct& s, const Value& v) {
                access(s) = static_cast<Member>(std::get<std::int64_t>(v));
            };
        } else {
            static_assert(std::is_floating_point_v<Member>, "bind bool, integer, float, double or an enum");
            d.type = ParameterType::number;
            entry.read = [access](const Struct& s) -> Value {
                return as_written(access(const_cast<Struct&>(s)));
            };
            entry.write = [access](Struct& s, const Value& v) {
                access(s) = static_cast<Member>(std::get<double>(v));
            };
        }
        d.default_value = entry.read(Struct{});
        entries_.push_back(std::move(entry));
        return *this;
    }

    std::vector<Entry> entries_;
};

}  // namespace ir
