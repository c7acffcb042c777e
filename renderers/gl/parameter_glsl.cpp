#include <array>
#include <cctype>
#include <cstring>
#include <limits>

#include "renderers/gl/program.h"

namespace ir::gl {
namespace {

/// The key as a GLSL identifier: other signs become single underscores (double ones are reserved).
std::string identifier(const std::string& key, bool capitals) {
    std::string name;
    for (const char c : key) {
        const auto sign = static_cast<unsigned char>(c);
        if (std::isalnum(sign))
            name += capitals ? static_cast<char>(std::toupper(sign)) : c;
        else if (name.empty() || name.back() != '_')
            name += '_';
    }
    return name;
}

bool in_block(const ParameterDescription& parameter) {
    return parameter.on_change != OnChange::recompile;
}

const char* block_type(ParameterType type) {
    static constexpr std::array names{"uint", "int", "float", "int"};  // in the order of ParameterType
    return names.at(static_cast<std::size_t>(type));
}

GLint driver_type(ParameterType type) {
    static constexpr std::array<GLint, 4> types{GL_UNSIGNED_INT, GL_INT, GL_FLOAT, GL_INT};
    return types.at(static_cast<std::size_t>(type));
}

const Value& value_of(const ParameterDescription& parameter, const Settings& settings) {
    const auto found = settings.find(parameter.key);
    if (found == settings.end())
        throw UsageError("parameter '" + parameter.key + "' has no value; complete the settings first");
    return found->second;
}

/// Integers and choices as the 32 bits that GLSL has for them.
std::int32_t integer_of(const ParameterDescription& parameter, const Value& value) {
    if (parameter.type == ParameterType::choice) return parameter.choice_index(std::get<std::string>(value));
    const auto number = std::get<std::int64_t>(value);
    if (number < std::numeric_limits<std::int32_t>::min() ||
        number > std::numeric_limits<std::int32_t>::max())
        throw UsageError("parameter '" + parameter.key + "': " + std::to_string(number) +
                         " does not fit into 32 bits");
    return static_cast<std::int32_t>(number);
}

std::string literal(const ParameterDescription& parameter, const Value& value) {
    if (parameter.type == ParameterType::toggle) return std::get<bool>(value) ? "1" : "0";
    std::string text = parameter.type == ParameterType::number ? ir::to_string(value)
                                                               : std::to_string(integer_of(parameter, value));
    if (parameter.type == ParameterType::number && text.find_first_of(".e") == std::string::npos)
        text += ".0";
    return text.starts_with('-') ? "(" + text + ")" : text;
}

std::uint32_t block_word(const ParameterDescription& parameter, const Value& value) {
    switch (parameter.type) {
        case ParameterType::toggle:
            return std::get<bool>(value) ? 1 : 0;
        case ParameterType::number: {
            const auto number = static_cast<float>(std::get<double>(value));
            std::uint32_t word = 0;
            std::memcpy(&word, &number, sizeof word);
            return word;
        }
        default:
            return static_cast<std::uint32_t>(integer_of(parameter, value));
    }
}

std::string choice_constants(const ParameterDescription& parameter) {
    std::string text;
    for (std::size_t i = 0; i < parameter.choices.size(); ++i)
        text += "const int " + identifier(parameter.key + "_" + parameter.choices[i].key, true) + " = " +
                std::to_string(i) + ";\n";
    return text;
}

[[noreturn]] void report_difference(const ParameterDescription& parameter, const std::string& problem) {
    throw Error("parameter block: '" + parameter.key + "' " + problem +
                "; the shader and the description do not belong together");
}

}  // namespace

std::string parameter_glsl(const std::vector<ParameterDescription>& parameters, const Settings& settings) {
    std::string constants, defines, members;
    for (const auto& parameter : parameters) {
        constants += choice_constants(parameter);
        if (in_block(parameter))
            members += std::string("    ") + block_type(parameter.type) + " " +
                       identifier(parameter.key, false) + ";\n";
        else
            defines += "#define " + identifier(parameter.key, true) + " " +
                       literal(parameter, value_of(parameter, settings)) + "\n";
    }
    if (members.empty()) return constants + defines;
    return constants + defines + "layout(std430) readonly buffer Parameters {\n" + members + "} params;\n";
}

std::vector<std::uint32_t> parameter_block(const std::vector<ParameterDescription>& parameters,
                                           const Settings& settings) {
    std::vector<std::uint32_t> words;
    for (const auto& parameter : parameters)
        if (in_block(parameter)) words.push_back(block_word(parameter, value_of(parameter, settings)));
    return words;
}

void check_parameter_block(const Api& api, GLuint program,
                           const std::vector<ParameterDescription>& parameters) {
    // A program that does not read its parameters has no such block.
    if (api.GetProgramResourceIndex(program, GL_SHADER_STORAGE_BLOCK, "Parameters") == GL_INVALID_INDEX)
        return;
    GLint expected = 0;
    for (const auto& parameter : parameters) {
        if (!in_block(parameter)) continue;
        const std::string name = "Parameters." + identifier(parameter.key, false);
        const GLuint index = api.GetProgramResourceIndex(program, GL_BUFFER_VARIABLE, name.c_str());
        if (index == GL_INVALID_INDEX) report_difference(parameter, "is not in the program's block");
        const std::array<GLenum, 2> properties{GL_OFFSET, GL_TYPE};
        std::array<GLint, 2> values{-1, 0};
        api.GetProgramResourceiv(program, GL_BUFFER_VARIABLE, index, 2, properties.data(), 2, nullptr,
                                 values.data());
        if (values[0] != expected)
            report_difference(parameter, "is at byte " + std::to_string(values[0]) + " instead of " +
                                             std::to_string(expected));
        if (values[1] != driver_type(parameter.type)) report_difference(parameter, "has another type");
        expected += 4;
    }
}

}  // namespace ir::gl
