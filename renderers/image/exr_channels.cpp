#include "renderers/image/exr_channels.h"

#include "renderers/core/error.h"
#include "renderers/image/exr.h"

namespace ir {

ChannelName split_channel_name(const std::string& full_name) {
    const auto dot = full_name.rfind('.');
    if (dot == std::string::npos) return {"", full_name};
    return {full_name.substr(0, dot), full_name.substr(dot + 1)};
}

int channel_rank(const std::string& channel) {
    static const std::string order = "RGBAXYZWUV";
    const auto found = channel.size() == 1 ? order.find(channel[0]) : std::string::npos;
    return static_cast<int>(found == std::string::npos ? order.size() : found);
}

std::vector<std::string> standard_channels(int channels, bool vector_valued) {
    switch (channels) {
        case 1:
            return {"Y"};
        case 2:
            return {"X", "Y"};
        case 3:
            return vector_valued ? std::vector<std::string>{"X", "Y", "Z"}
                                 : std::vector<std::string>{"R", "G", "B"};
        case 4:
            return vector_valued ? std::vector<std::string>{"X", "Y", "Z", "W"}
                                 : std::vector<std::string>{"R", "G", "B", "A"};
        default:
            throw UsageError("an image of " + std::to_string(channels) +
                             " channels has no standard channel names; use 1 to 4 channels");
    }
}

}  // namespace ir
