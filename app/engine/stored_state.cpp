#include "app/engine/stored_state.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <algorithm>
#include <charconv>
#include <cstring>
#include <nlohmann/json.hpp>

#include "app/engine/state_layout.h"
#include "renderers/core/error.h"
#include "renderers/core/file_system.h"
#include "renderers/core/limits.h"
#include "renderers/image/exr_parts.h"

namespace ir::engine {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* samples_attribute = "interreflect.state.samples";
constexpr const char* fingerprint_attribute = "interreflect.state.fingerprint";
constexpr const char* origins_attribute = "interreflect.state.origins";

std::vector<StateOrigin> origins_of(const std::string& text) {
    std::vector<StateOrigin> origins;
    for (const auto& json : nlohmann::json::parse(text))
        origins.push_back({json.at("build").get<std::string>(), json.at("driver").get<std::string>(),
                           json.at("backend").get<std::string>(), json.at("date").get<std::string>(),
                           json.at("samples").get<std::uint64_t>(), json.value("processor", std::string())});
    return origins;
}

namespace fs = std::filesystem;

constexpr const char* no_state = "does not say what state it holds; it is damaged";

std::uint64_t samples_in(const ImageAttributes& attributes, const fs::path& file) {
    const auto found = attributes.find(samples_attribute);
    const auto text = found == attributes.end() ? std::string() : found->second;
    std::uint64_t samples = 0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), samples);
    if (parsed.ec != std::errc{} || parsed.ptr != text.data() + text.size() || samples == 0)
        throw InputError(file.string(), "", no_state);
    return samples;
}

/// Holds which entries the file has, as JSON.
constexpr const char* entries_attribute = "interreflect.history";

Imath::Box2i window_of(const StatePart& part) {
    return {{0, 0}, {part.width - 1, part.height - 1}};
}

Imf::PixelType pixel_type(const StateChannel& channel) {
    return channel.type == StateChannel::Type::half     ? Imf::HALF
           : channel.type == StateChannel::Type::float_ ? Imf::FLOAT
                                                        : Imf::UINT;
}

Imf::FrameBuffer frame_buffer(StatePart& part) {
    Imf::FrameBuffer buffer;
    for (auto& channel : part.channels)
        buffer.insert(channel.name,
                      Imf::Slice(pixel_type(channel), reinterpret_cast<char*>(channel.base), channel.step,
                                 channel.step * static_cast<std::size_t>(part.width)));
    return buffer;
}

std::vector<Imf::Header> headers_of(const std::vector<StatePart>& parts, const graph::History& history,
                                    const ImageAttributes& attributes) {
    std::vector<Imf::Header> headers;
    for (const auto& part : parts) {
        Imf::Header header(window_of(parts.front()), window_of(part));
        header.compression() = Imf::ZIP_COMPRESSION;
        header.setType(Imf::SCANLINEIMAGE);
        if (parts.size() > 1) header.setName(part.name);
        for (const auto& channel : part.channels)
            header.channels().insert(channel.name, Imf::Channel(pixel_type(channel)));
        headers.push_back(std::move(header));
    }
    for (const auto& [key, value] : attributes) headers.front().insert(key, Imf::StringAttribute(value));
    headers.front().insert(entries_attribute, Imf::StringAttribute(describe_entries(history)));
    return headers;
}

void check_part(const StatePart& part, const Imf::Header& header, const std::string& file) {
    if (header.dataWindow() != window_of(part))
        throw InputError(file, "", "its images are not of the size that it says; it is damaged");
    for (const auto& channel : part.channels) {
        const auto* found = header.channels().findChannel(channel.name);
        if (!found || found->type != pixel_type(channel))
            throw InputError(file, "channel '" + in_one_line(channel.name) + "'",
                             "is missing or of another type; the file is damaged");
    }
}

graph::History read_parts(Imf::MultiPartInputFile& input, const std::string& file,
                          ImageAttributes& attributes) {
    auto left = max_expanded(fs::file_size(file));
    for (int i = 0; i < input.parts(); ++i) take_bytes_of_part(input.header(i), file, left);
    attributes = attributes_of(input.header(0));
    const auto described = attributes.find(entries_attribute);
    if (described == attributes.end()) throw InputError(file, "", "is an image, not a stored state");
    auto history = described_entries(described->second, file, fs::file_size(file));
    attributes.erase(described);
    StateLayout layout(history);
    if (input.parts() != static_cast<int>(layout.parts().size()))
        throw InputError(file, "", "has another number of parts than it says; it is damaged");
    for (std::size_t i = 0; i < layout.parts().size(); ++i) {
        auto& part = layout.parts()[i];
        check_part(part, input.header(static_cast<int>(i)), file);
        Imf::InputPart pixels(input, static_cast<int>(i));
        pixels.setFrameBuffer(frame_buffer(part));
        pixels.readPixels(0, part.height - 1);
    }
    layout.narrow(history);
    return history;
}

void write_parts(std::ostream& out, StateLayout& layout, const std::vector<Imf::Header>& headers) {
    ExrStream stream(out);
    Imf::MultiPartOutputFile output(stream, headers.data(), static_cast<int>(headers.size()));
    for (std::size_t i = 0; i < layout.parts().size(); ++i) {
        Imf::OutputPart part(output, static_cast<int>(i));
        part.setFrameBuffer(frame_buffer(layout.parts()[i]));
        part.writePixels(layout.parts()[i].height);
    }
}

}  // namespace

std::string to_json_text(const std::vector<StateOrigin>& origins) {
    Json list = Json::array();
    for (const auto& origin : origins)
        list.push_back({{"build", origin.build},
                        {"driver", origin.driver},
                        {"backend", origin.backend},
                        {"processor", origin.processor},
                        {"date", origin.date},
                        {"samples", origin.samples}});
    return list.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void store(const std::filesystem::path& file, const StoredState& state, const ImageAttributes& attributes) {
    auto all = attributes;
    all[samples_attribute] = std::to_string(state.samples);
    all[fingerprint_attribute] = state.fingerprint;
    all[origins_attribute] = to_json_text(state.origins);
    write_state(file, state.history, all);
}

std::uint64_t stored_samples(const fs::path& file) {
    return samples_in(read_exr_attributes(file), file);
}

StoredState load_state(const std::filesystem::path& file) {
    StoredState state;
    ImageAttributes attributes;
    state.history = read_state(file, &attributes);
    state.samples = samples_in(attributes, file);
    state.fingerprint = attributes[fingerprint_attribute];
    if (state.fingerprint.empty()) throw InputError(file.string(), "", no_state);
    try {
        state.origins = origins_of(attributes[origins_attribute]);
    } catch (const std::exception&) {
        throw InputError(file.string(), "", "does not say where its state comes from; it is damaged");
    }
    return state;
}

void write_state(const fs::path& file, const graph::History& history, const ImageAttributes& attributes) {
    if (history.entries.empty()) throw Error(file.string() + ": there is no history to store");
    // OpenEXR only reads from the frame buffer of an output file.
    StateLayout layout(const_cast<graph::History&>(history));
    layout.widen(history);
    write_atomically(real_file_system(), file, [&](std::ostream& out) {
        try {
            write_parts(out, layout, headers_of(layout.parts(), history, attributes));
        } catch (const Error&) {
            throw;
        } catch (const std::exception& problem) {
            throw Error(file.string() + ": cannot be written (" + problem.what() + ")");
        }
    });
}

graph::History read_state(const fs::path& file, ImageAttributes* attributes) {
    require_regular_file(file);
    require_whole_header(file);
    try {
        Imf::MultiPartInputFile input(file.c_str(), threads_of_reading());
        ImageAttributes found;
        auto history = read_parts(input, file.string(), found);
        if (attributes) *attributes = std::move(found);
        return history;
    } catch (const Error&) {
        throw;
    } catch (const std::exception& problem) {
        throw InputError(file.string(), "", "is not a readable state (" + in_one_line(problem.what()) + ")");
    }
}

}  // namespace ir::engine
