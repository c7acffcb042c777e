#include "app/engine/state_layout.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "renderers/core/error.h"
#include "renderers/core/limits.h"
#include "renderers/image/exr_parts.h"

namespace ir::engine {
namespace {

using Json = nlohmann::ordered_json;
using Entry = graph::History::Entry;

/// Words of a buffer that stand side by side.
constexpr std::uint64_t words_across = 4096;

constexpr gl::Format formats[] = {gl::Format::r8,     gl::Format::rgba8,    gl::Format::r16f,
                                  gl::Format::rg16f,  gl::Format::rgba16f,  gl::Format::r32f,
                                  gl::Format::rg32f,  gl::Format::rgba32f,  gl::Format::r32ui,
                                  gl::Format::rg32ui, gl::Format::depth32f, gl::Format::srgba8};

int layers_of(const Entry& entry) {
    return std::max(1, entry.shape.layers);
}

std::uint64_t bytes_of(const Entry& entry) {
    if (!entry.is_image) return entry.element_bytes * entry.elements;
    return std::uint64_t{1} * static_cast<std::uint64_t>(entry.shape.width) *
           static_cast<std::uint64_t>(entry.shape.height) * static_cast<std::uint64_t>(layers_of(entry)) *
           static_cast<std::uint64_t>(gl::info(entry.shape.format).bytes);
}

bool is_eight_bit(const Entry& entry) {
    return entry.is_image && gl::info(entry.shape.format).type == GL_UNSIGNED_BYTE;
}

StateChannel::Type type_of(gl::Format format) {
    const auto type = gl::info(format).type;
    return type == GL_HALF_FLOAT ? StateChannel::Type::half
           : type == GL_FLOAT    ? StateChannel::Type::float_
                                 : StateChannel::Type::uint;
}

Json to_json(const Entry& entry) {
    Json json{{"key", entry.key}};
    if (entry.is_image) {
        json["format"] = gl::info(entry.shape.format).name;
        json["size"] = {entry.shape.width, entry.shape.height};
        json["layers"] = entry.shape.layers;
    } else {
        json["element_bytes"] = entry.element_bytes;
        json["elements"] = entry.elements;
    }
    return json;
}

gl::Format format_of(const std::string& name) {
    for (const auto format : formats)
        if (gl::info(format).name == name) return format;
    throw std::runtime_error("unknown format '" + name + "'");
}

int within(std::int64_t number, std::int64_t min, std::int64_t max) {
    if (number < min || number > max) throw std::runtime_error("a size is out of range");
    return static_cast<int>(number);
}

Entry from_json(const nlohmann::json& json) {
    Entry entry;
    entry.key = json.at("key").get<std::string>();
    entry.is_image = json.contains("format");
    if (entry.is_image) {
        entry.shape.format = format_of(json.at("format").get<std::string>());
        entry.shape.width = within(json.at("size").at(0).get<std::int64_t>(), 1, max_image_side);
        entry.shape.height = within(json.at("size").at(1).get<std::int64_t>(), 1, max_image_side);
        entry.shape.layers = within(json.at("layers").get<std::int64_t>(), 0, 4096);
    } else {
        entry.element_bytes =
            static_cast<std::uint64_t>(within(json.at("element_bytes").get<std::int64_t>(), 4, 1 << 16));
        entry.elements =
            static_cast<std::uint64_t>(within(json.at("elements").get<std::int64_t>(), 1, INT32_MAX));
        if (entry.element_bytes % 4 != 0) throw std::runtime_error("elements are not made of words");
    }
    return entry;
}

}  // namespace

StateLayout::StateLayout(graph::History& history) {
    for (auto& entry : history.entries) entry.is_image ? add_image(entry) : add_words(entry);
}

StatePart& StateLayout::part_of(const std::string& key, int width, int height) {
    for (auto& part : parts_)
        if (part.width == width && part.height == height) return part;
    parts_.push_back({key, width, height, {}});
    return parts_.back();
}

void StateLayout::add_image(Entry& entry) {
    const auto& format = gl::info(entry.shape.format);
    auto& part = part_of(entry.key, entry.shape.width, entry.shape.height);
    const auto names = standard_channels(format.channels);
    const auto texels =
        static_cast<std::size_t>(entry.shape.width) * static_cast<std::size_t>(entry.shape.height);
    auto texel = static_cast<std::size_t>(format.bytes);
    std::byte* bytes = entry.bytes.data();
    if (is_eight_bit(entry)) {
        auto& wide = wide_[entry.key];
        wide.assign(entry.bytes.size(), 0);
        bytes = reinterpret_cast<std::byte*>(wide.data());
        texel *= 4;
    }
    for (int layer = 0; layer < layers_of(entry); ++layer) {
        const auto prefix =
            entry.key + (entry.shape.layers > 0 ? ".layer" + std::to_string(layer) : std::string()) + ".";
        for (std::size_t c = 0; c < names.size(); ++c)
            part.channels.push_back(
                {prefix + names[c], type_of(entry.shape.format),
                 bytes + static_cast<std::size_t>(layer) * texels * texel + c * texel / names.size(), texel});
    }
}

void StateLayout::add_words(Entry& entry) {
    const auto words = entry.bytes.size() / 4;
    const auto width = std::clamp<std::uint64_t>(words, 1, words_across);
    const auto height = std::max<std::uint64_t>(1, (words + width - 1) / width);
    auto& wide = wide_[entry.key];
    wide.assign(width * height, 0);
    part_of(entry.key, static_cast<int>(width), static_cast<int>(height))
        .channels.push_back(
            {entry.key + ".words", StateChannel::Type::uint, reinterpret_cast<std::byte*>(wide.data()), 4});
}

void StateLayout::widen(const graph::History& history) {
    for (const auto& entry : history.entries) {
        const auto found = wide_.find(entry.key);
        if (found == wide_.end()) continue;
        if (entry.is_image)
            std::transform(entry.bytes.begin(), entry.bytes.end(), found->second.begin(),
                           [](std::byte byte) { return std::to_integer<std::uint32_t>(byte); });
        else
            std::memcpy(found->second.data(), entry.bytes.data(), entry.bytes.size());
    }
}

void StateLayout::narrow(graph::History& history) const {
    for (auto& entry : history.entries) {
        const auto found = wide_.find(entry.key);
        if (found == wide_.end()) continue;
        if (entry.is_image)
            std::transform(found->second.begin(), found->second.end(), entry.bytes.begin(),
                           [](std::uint32_t word) { return static_cast<std::byte>(word); });
        else
            std::memcpy(entry.bytes.data(), found->second.data(), entry.bytes.size());
    }
}

std::string describe_entries(const graph::History& history) {
    Json json = Json::array();
    for (const auto& entry : history.entries) json.push_back(to_json(entry));
    return json.dump();
}

graph::History described_entries(const std::string& text, const std::string& file, std::uint64_t file_bytes) {
    graph::History history;
    std::uint64_t sum = 0;
    std::set<std::string> keys;
    try {
        for (const auto& json : nlohmann::json::parse(text)) {
            history.entries.push_back(from_json(json));
            sum += bytes_of(history.entries.back());
            if (!keys.insert(history.entries.back().key).second)
                throw std::runtime_error("an entry stands twice");
        }
    } catch (const std::exception& problem) {
        throw InputError(file, "",
                         "does not say what it holds (" + in_one_line(problem.what()) + "); it is damaged");
    }
    if (history.entries.empty() || sum > max_expanded(file_bytes))
        throw InputError(file, "", "cannot hold what it says; it is damaged");
    for (auto& entry : history.entries) entry.bytes.resize(bytes_of(entry));
    return history;
}

}  // namespace ir::engine
