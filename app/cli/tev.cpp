// `interreflect-cli tev`: pictures with all their layers in a running tev.
#include <map>
#include <utility>

#include "app/cli/command.h"
#include "renderers/image/exr.h"
#include "renderers/image/tev.h"

namespace ir::cli {
namespace {

struct TevFlags {
    std::vector<std::string> files;
    std::string address = tev_address;
};

/// A picture of several sizes is one for each in tev, which knows a picture by its name.
void show(const std::string& file, const std::string& address) {
    std::map<std::pair<int, int>, std::vector<ImageLayer>> sizes;
    for (auto& layer : read_layers(file))
        sizes[{layer.image.width, layer.image.height}].push_back(std::move(layer));
    for (const auto& [size, layers] : sizes) {
        const auto text = std::to_string(size.first) + "x" + std::to_string(size.second);
        send_to_tev(sizes.size() == 1 ? file : file + " " + text, layers, address);
    }
}

}  // namespace

void add_tev(CLI::App& app, Run& run) {
    auto flags = std::make_shared<TevFlags>();
    auto* command = app.add_subcommand("tev", "Show pictures with all layers in a running tev");
    command->add_option("P", flags->files, "Pictures: EXR, HDR, PNG, JPEG, TIFF or WebP")->required();
    command->add_option("--to", flags->address, "HOST:PORT where tev listens")->capture_default_str();
    command->callback([flags, &run] {
        run = [flags] {
            for (const auto& file : flags->files) show(file, flags->address);
            return done;
        };
    });
}

}  // namespace ir::cli
