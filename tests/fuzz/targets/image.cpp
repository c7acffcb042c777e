#include "renderers/core/error.h"
#include "renderers/image/exr.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/targets/target.h"

using namespace ir;

/// Pictures and maps: EXR, HDR, PNG, JPEG, TIFF, WebP.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto file = fuzz::write_input("a.image", data, size);
    try {
        const auto image = read_image(file);
        fuzz::require(image.pixels.size() == std::size_t(image.width) * image.height * image.channels,
                      "not a value for each channel of each pixel");
    } catch (const InputError& error) {
        fuzz::require_one_line(error.what(), file + ": ");
    }
    try {
        ImageAttributes attributes;
        read_exr(file, &attributes);
    } catch (const InputError& error) {
        fuzz::require_one_line(error.what(), file + ": ");
    }
    return 0;
}
