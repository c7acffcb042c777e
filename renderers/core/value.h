#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <variant>

namespace ir {

/// One parameter's value. A choice is held by the key of the chosen entry, so that files stay readable.
using Value = std::variant<bool, std::int64_t, double, std::string>;

/// Values by parameter key; a method's complete configuration.
using Settings = std::map<std::string, Value>;

/// The shortest form that reads back bit for bit: "0.25", "1e-05", "inf", "nan".
std::string shortest_text(double number);
std::string shortest_text(float number);

/// "true", "12", "0.25" or the choice's key; numbers in the shortest form that reads back bit for bit.
std::string to_string(const Value& value);

/// The double nearest to the shortest decimal that reads back as this float: 0.1f gives 0.1, not
/// 0.10000000149011612. Files then hold what somebody wrote.
double as_written(float number);
inline double as_written(double number) {
    return number;
}

}  // namespace ir
