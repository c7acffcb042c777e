#include <algorithm>
#include <iostream>

#include "app/cli/command.h"
#include "app/cli/output_files.h"
#include "app/cli/pixel_flags.h"
#include "app/cli/run_frames.h"
#include "app/engine/compared_sides.h"
#include "renderers/core/error.h"
#include "renderers/core/words.h"
#include "renderers/core/write_file.h"
#include "renderers/plot/line_profile.h"
#include "renderers/plot/plot_svg.h"

namespace ir::cli {
namespace {

struct ProfileFlags {
    std::vector<std::string> files;
    std::string layer, line, channel = "one", csv, svg;
};

/// "one", "each", or the name of a channel that a picture has.
int choice_of(const std::string& word, const std::vector<engine::Side>& sides) {
    if (word == "one") return one_number;
    if (word == "each") return all_channels;
    std::vector<std::string> known = {"one", "each"};
    for (const auto& side : sides) {
        const auto names = channel_choices(side.semantic, side.image.channels);
        for (std::size_t c = 0; c < names.size(); ++c) {
            if (names[c] == word) return int(c);
            if (std::find(known.begin(), known.end(), names[c]) == known.end()) known.push_back(names[c]);
        }
    }
    throw UsageError("--channel '" + word + "' is none of the pictures'" + known_are(word, known));
}

PixelLine line_of(const std::string& text, const engine::Side& side) {
    const auto n = pixels_of(text, 4, "--line", "x1,y1,x2,y2");
    for (std::size_t i = 0; i < 4; ++i)
        if (n[i] < 0 || n[i] >= (i % 2 == 0 ? side.image.width : side.image.height))
            throw UsageError("--line '" + text + "' leaves " + side.file + ", which has " +
                             std::to_string(side.image.width) + "x" + std::to_string(side.image.height) +
                             " pixels");
    return {n[0], n[1], n[2], n[3]};
}

int print_profile(const ProfileFlags& flags) {
    OutputFiles files;
    for (const auto& file : flags.files) files.reads("FILE", file);
    for (const auto& [option, file] : {std::pair{"--csv", &flags.csv}, {"--svg", &flags.svg}}) {
        files.writes(option, *file);
        if (!file->empty()) require_folder_of(*file, option);
    }
    std::vector<engine::Side> sides;
    for (const auto& file : flags.files) sides.push_back(engine::load_side(file, flags.layer));
    std::vector<MeasuredImage> images;
    PixelLine line;
    for (const auto& side : sides) {
        line = line_of(flags.line, side);
        images.push_back({side.file, &side.image, side.mask(), nullptr, side.semantic});
    }
    const auto profile = line_profile(images, line, choice_of(flags.channel, sides));
    if (flags.csv.empty() && flags.svg.empty()) std::cout << profile_csv(profile);
    if (!flags.csv.empty()) write_file(flags.csv, profile_csv(profile));
    if (flags.svg.empty()) return done;
    auto plot = plot_of(profile, flags.layer.empty() ? "Value" : "Value of " + flags.layer);
    plot.title = flags.line;
    write_file(flags.svg, plot_svg(plot, plot_svg_width, plot_svg_height, true));
    return done;
}

}  // namespace

void add_profile(CLI::App& app, Run& run) {
    auto flags = std::make_shared<ProfileFlags>();
    auto* command = app.add_subcommand("profile", "Values of pictures along a line");
    command->add_option("FILE", flags->files, "EXR files, or others that hold one image")->required();
    command
        ->add_option("--line", flags->line, "x1,y1,x2,y2: from the middle of a pixel to that of another one")
        ->required();
    command->add_option("--layer", flags->layer, "Layer of EXR files (default: the main one)");
    command->add_option("--channel", flags->channel,
                        "What is read of a pixel: one (luminance of a colour, length of a vector), each, or "
                        "the name of a channel such as R (default: one)");
    command->add_option("--csv", flags->csv, "File for the values (default: standard output)");
    command->add_option("--svg", flags->svg, "File for a drawing of them");
    command->callback([flags, &run] { run = [flags] { return print_profile(*flags); }; });
}

}  // namespace ir::cli
