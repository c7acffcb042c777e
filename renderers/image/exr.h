#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "renderers/core/file_system.h"
#include "renderers/image/image.h"

namespace ir {

using ImageAttributes = std::map<std::string, std::string>;

/// Writes 32-bit float layers to one EXR file (written to a temporary, then renamed). Layers of the first
/// layer's size share the first part, with channels "LAYER.CHANNEL"; each other size becomes a part of its
/// own, named by its layer. Throws Error.
void write_exr(const std::filesystem::path& file, const std::vector<ImageLayer>& layers,
               const ImageAttributes& attributes);
/// The same for a file of a project: a link is replaced, not followed.
void write_exr(FileSystem& files, const std::filesystem::path& file, const std::vector<ImageLayer>& layers,
               const ImageAttributes& attributes);

/// From here on EXR files are packed and unpacked in threads; before, in the caller's. Not for a process that
/// forks: its copy would wait for threads that it does not have.
void use_threads_for_exr();

/// All layers of all parts. Throws InputError.
std::vector<ImageLayer> read_exr(const std::filesystem::path& file, ImageAttributes* attributes = nullptr);

/// Only what the header says. Throws InputError.
ImageAttributes read_exr_attributes(const std::filesystem::path& file);

/// The standard channel names for 1, 2, 3 or 4 channels of an output ("Y"; "X","Y"; "R","G","B"; …).
std::vector<std::string> standard_channels(int channels, bool vector_valued = false);

/// Any image file that OpenImageIO or OpenEXR reads, linear floats; `layer` chooses an EXR layer by name.
/// Throws InputError (also for an unknown layer, listing the known ones).
Image read_image(const std::filesystem::path& file, const std::string& layer = {});

/// All layers of an EXR file, with the texts of its header; a picture in another format as one layer without
/// a name. Throws InputError.
std::vector<ImageLayer> read_layers(const std::filesystem::path& file, ImageAttributes* attributes = nullptr);

/// The bytes of a PNG as write_png has it; `exposure` in stops. Throws Error.
std::string png_of(const Image& linear, double exposure = 0);
/// 8-bit sRGB PNG of a linear image; values are clamped to [0,1] after `exposure` stops. Throws Error.
void write_png(const std::filesystem::path& file, const Image& linear, double exposure = 0);

}  // namespace ir
