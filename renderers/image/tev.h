#pragma once

#include <string>
#include <vector>

#include "renderers/image/image.h"

/// Pictures shown by the viewer tev [Tev], which listens for them while it runs.
namespace ir {

/// Where tev listens unless it was told otherwise by its --host, HOST:PORT.
inline constexpr const char* tev_address = "127.0.0.1:14158";

/// Shows the layers as one picture of this name, channels "LAYER.CHANNEL". A picture that has the name
/// already is replaced. The layers must have one size. Waits at most some seconds where tev does not answer.
/// Throws UsageError for an address that is none, and Error.
void send_to_tev(const std::string& name, const std::vector<ImageLayer>& layers,
                 const std::string& address = tev_address);

}  // namespace ir
