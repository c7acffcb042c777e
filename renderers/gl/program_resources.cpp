#include "renderers/gl/program_resources.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

namespace ir::gl {
namespace {

using Kind = ProgramResource::Kind;
using Tokens = std::vector<std::string>;

bool in_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

/// The end of the comment or directive that begins at `at`; `at` where none does.
std::size_t end_of_skipped(const std::string& text, std::size_t at) {
    if (text.compare(at, 2, "/*") == 0) return std::min(text.size(), text.find("*/", at + 2)) + 2;
    if (text[at] != '#' && text.compare(at, 2, "//") != 0) return at;
    std::size_t end = text.find('\n', at);
    while (end != std::string::npos && text[end - 1] == '\\') end = text.find('\n', end + 1);
    return std::min(text.size(), end);
}

/// Words and single signs, without comments and directives.
Tokens tokens_of(const std::string& text) {
    Tokens tokens;
    for (std::size_t at = 0; at < text.size();) {
        if (const auto end = end_of_skipped(text, at); end > at) {
            at = end;
            continue;
        }
        std::size_t end = at;
        while (end < text.size() && in_word(text[end])) ++end;
        if (end == at) ++end;
        if (!std::isspace(static_cast<unsigned char>(text[at]))) tokens.push_back(text.substr(at, end - at));
        at = end;
    }
    return tokens;
}

bool is_format(const std::string& word) {
    static const std::set<std::string> formats{"r8",   "rgba8", "r16f",    "rg16f", "rgba16f",
                                               "r32f", "rg32f", "rgba32f", "r32ui", "rg32ui"};
    return formats.contains(word);
}

bool is_opaque(const std::string& type) {
    return type.find("sampler") != std::string::npos || type.find("image") != std::string::npos;
}

Kind kind_of(GLenum type) {
    return type >= GL_IMAGE_1D && type <= GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE_ARRAY ? Kind::image
                                                                                     : Kind::texture;
}

bool is_resource(GLenum type) {
    static constexpr std::array types{
        GL_SAMPLER_2D,           GL_SAMPLER_2D_ARRAY,        GL_INT_SAMPLER_2D,
        GL_INT_SAMPLER_2D_ARRAY, GL_UNSIGNED_INT_SAMPLER_2D, GL_UNSIGNED_INT_SAMPLER_2D_ARRAY};
    return kind_of(type) == Kind::image || std::find(types.begin(), types.end(), type) != types.end();
}

std::string name_at(const Api& api, GLuint program, GLenum interface, GLuint index) {
    std::array<char, 256> name{};
    GLsizei length = 0;
    api.GetProgramResourceName(program, interface, index, name.size(), &length, name.data());
    return {name.data(), static_cast<std::size_t>(length)};
}

GLuint count_of(const Api& api, GLuint program, GLenum interface) {
    GLint count = 0;
    api.GetProgramInterfaceiv(program, interface, GL_ACTIVE_RESOURCES, &count);
    return static_cast<GLuint>(count);
}

struct ActiveUniform {
    std::string name;
    GLenum type;
    int count;
    GLint location;
};

std::vector<ActiveUniform> active_uniforms(const Api& api, GLuint program) {
    std::vector<ActiveUniform> uniforms;
    for (GLuint i = 0; i < count_of(api, program, GL_UNIFORM); ++i) {
        const std::array<GLenum, 3> properties{GL_TYPE, GL_ARRAY_SIZE, GL_LOCATION};
        std::array<GLint, 3> values{};
        api.GetProgramResourceiv(program, GL_UNIFORM, i, 3, properties.data(), 3, nullptr, values.data());
        const std::string name = name_at(api, program, GL_UNIFORM, i);
        uniforms.push_back(
            {name.substr(0, name.find('[')), static_cast<GLenum>(values[0]), values[1], values[2]});
    }
    std::sort(uniforms.begin(), uniforms.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
    return uniforms;
}

/// Adds what the linker made of the block's records: of "photons[0].power" the member power.
void add_records(const Api& api, GLuint program, GLuint block, ProgramResource& resource) {
    const auto properties = [&](GLenum interface, GLuint index, const std::vector<GLenum>& queried,
                                std::size_t values) {
        std::vector<GLint> result(values);
        api.GetProgramResourceiv(program, interface, index, static_cast<GLsizei>(queried.size()),
                                 queried.data(), static_cast<GLsizei>(values), nullptr, result.data());
        return result;
    };
    const auto count = properties(GL_SHADER_STORAGE_BLOCK, block, {GL_NUM_ACTIVE_VARIABLES}, 1)[0];
    const auto variables =
        properties(GL_SHADER_STORAGE_BLOCK, block, {GL_ACTIVE_VARIABLES}, static_cast<std::size_t>(count));
    for (const auto variable : variables) {
        const auto index = static_cast<GLuint>(variable);
        const auto name = name_at(api, program, GL_BUFFER_VARIABLE, index);
        const auto dot = name.find("[0].");
        if (dot == std::string::npos) continue;
        const auto values = properties(GL_BUFFER_VARIABLE, index,
                                       {GL_OFFSET, GL_TOP_LEVEL_ARRAY_STRIDE, GL_TYPE, GL_ARRAY_SIZE}, 4);
        auto member = name.substr(dot + 4);
        const bool is_array = member.ends_with("[0]");
        if (is_array) member.resize(member.size() - 3);
        resource.members.push_back({member, values[0], static_cast<GLenum>(values[2]), values[3], is_array});
        resource.stride = values[1];
    }
    // drivers list them in orders of their own
    std::ranges::sort(resource.members, {}, &ProgramResource::Member::offset);
}

}  // namespace

std::string ProgramResource::element(int index) const {
    return count == 1 ? name : name + "[" + std::to_string(index) + "]";
}

bool ProgramResource::is_array_texture() const {
    static constexpr std::array types{
        GL_SAMPLER_2D_ARRAY, GL_INT_SAMPLER_2D_ARRAY, GL_UNSIGNED_INT_SAMPLER_2D_ARRAY,
        GL_IMAGE_2D_ARRAY,   GL_INT_IMAGE_2D_ARRAY,   GL_UNSIGNED_INT_IMAGE_2D_ARRAY};
    return std::find(types.begin(), types.end(), type) != types.end();
}

bool ProgramResource::is_integer() const {
    static constexpr std::array types{GL_UNSIGNED_INT_SAMPLER_2D,
                                      GL_UNSIGNED_INT_SAMPLER_2D_ARRAY,
                                      GL_INT_SAMPLER_2D,
                                      GL_INT_SAMPLER_2D_ARRAY,
                                      GL_UNSIGNED_INT_IMAGE_2D,
                                      GL_UNSIGNED_INT_IMAGE_2D_ARRAY,
                                      GL_INT_IMAGE_2D,
                                      GL_INT_IMAGE_2D_ARRAY};
    return std::find(types.begin(), types.end(), type) != types.end();
}

void ResourceDeclarations::add(const std::string& text) {
    const Tokens tokens = tokens_of(text);
    std::size_t begin = 0;  // of the statement
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
        if (tokens[i] == ";" || tokens[i] == "{" || tokens[i] == "}") begin = i + 1;
        if (tokens[i] != "buffer" && tokens[i] != "uniform") continue;
        std::size_t end = i + 1;
        while (end < tokens.size() && tokens[end] != ";" && tokens[end] != "{" && tokens[end] != "[") ++end;
        const std::string& name = tokens[end - 1];
        if (tokens[i] == "uniform" && (end < i + 3 || !is_opaque(tokens[end - 2]))) continue;
        Declaration found{.written =
                              tokens[i] == "buffer" || tokens[end - 2].find("image") != std::string::npos};
        for (std::size_t word = begin; word < end; ++word) {
            if (tokens[word] == "readonly") found.written = false;
            if (is_format(tokens[word])) found.format = tokens[word];
        }
        const auto [known, is_new] = declared_.emplace(name, found);
        if (is_new) continue;
        known->second.written |= found.written;
        if (known->second.format != found.format) known->second.format.clear();
    }
}

std::map<std::string, PlainUniform> plain_uniforms(const Api& api, GLuint program) {
    std::map<std::string, PlainUniform> uniforms;
    for (const auto& [name, type, count, location] : active_uniforms(api, program))
        if (location >= 0 && !is_resource(type)) uniforms[name] = {type, location};
    return uniforms;
}

std::vector<ProgramResource> assign_units(const Api& api, GLuint program,
                                          const ResourceDeclarations& declarations) {
    std::vector<ProgramResource> resources;
    std::map<Kind, GLuint> units;
    const auto add = [&](const std::string& name, Kind kind, GLenum type, int count) {
        const auto declared = declarations.declared_.find(name);
        if (declared == declarations.declared_.end()) return false;
        resources.push_back(
            {name, kind, type, units[kind], count, declared->second.written, declared->second.format});
        units[kind] += static_cast<GLuint>(count);
        return true;
    };
    std::map<std::string, GLuint> blocks;
    for (GLuint i = 0; i < count_of(api, program, GL_SHADER_STORAGE_BLOCK); ++i)
        blocks[name_at(api, program, GL_SHADER_STORAGE_BLOCK, i)] = i;
    for (const auto& [name, index] : blocks)
        if (add(name, Kind::buffer, GL_NONE, 1)) {
            api.ShaderStorageBlockBinding(program, index, resources.back().unit);
            add_records(api, program, index, resources.back());
        }
    for (const auto& [name, type, count, location] : active_uniforms(api, program)) {
        if (!is_resource(type) || !add(name, kind_of(type), type, count)) continue;
        std::vector<GLint> elements;
        for (int i = 0; i < count; ++i) elements.push_back(static_cast<GLint>(resources.back().unit) + i);
        api.ProgramUniform1iv(program, location, count, elements.data());
    }
    return resources;
}

}  // namespace ir::gl
