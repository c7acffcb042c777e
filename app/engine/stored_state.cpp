#include "app/engine/stored_state.h"

#include <charconv>
#include <nlohmann/json.hpp>

#include "app/engine/state_file.h"
#include "renderers/core/error.h"

namespace ir::engine {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* samples_attribute = "interreflect.state.samples";
constexpr const char* fingerprint_attribute = "interreflect.state.fingerprint";
constexpr const char* origins_attribute = "interreflect.state.origins";

std::vector<StateOrigin> origins_of(const std::string& text) {
    std::vector<StateOrigin> origins;
    for (const auto& json : Json::parse(text))
        origins.push_back({json.at("build").get<std::string>(), json.at("driver").get<std::string>(),
                           json.at("backend").get<std::string>(), json.at("date").get<std::string>(),
                           json.at("samples").get<std::uint64_t>(), json.value("processor", std::string())});
    return origins;
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

StoredState load_state(const std::filesystem::path& file) {
    StoredState state;
    ImageAttributes attributes;
    state.history = read_state(file, &attributes);
    const auto& samples = attributes[samples_attribute];
    const auto parsed = std::from_chars(samples.data(), samples.data() + samples.size(), state.samples);
    state.fingerprint = attributes[fingerprint_attribute];
    const bool is_whole = parsed.ec == std::errc{} && parsed.ptr == samples.data() + samples.size() &&
                          state.samples > 0 && !state.fingerprint.empty();
    if (!is_whole) throw InputError(file.string(), "", "does not say what state it holds; it is damaged");
    try {
        state.origins = origins_of(attributes[origins_attribute]);
    } catch (const std::exception&) {
        throw InputError(file.string(), "", "does not say where its state comes from; it is damaged");
    }
    return state;
}

}  // namespace ir::engine
