#pragma once

#include <string>
#include <vector>

/// How layers and channels are named in EXR files.
namespace ir {

/// "ldm.layers.Y" → {"ldm.layers", "Y"}; without a dot the layer is empty.
struct ChannelName {
    std::string layer, channel;
};
ChannelName split_channel_name(const std::string& full_name);

/// Position in which a channel is shown: R, G, B, A; X, Y, Z, W; U, V; others after them. Files keep channels
/// in alphabetical order.
int channel_rank(const std::string& channel);

}  // namespace ir
