#include "renderers/image/codecs/png.h"

#include <png.h>

#include <bit>
#include <cmath>
#include <csetjmp>
#include <cstring>
#include <fstream>
#include <functional>
#include <vector>

namespace ir {
namespace {

/// What libpng calls. It leaves its own functions by longjmp where something is wrong.
struct Source {
    std::function<bool(std::uint8_t* to, std::size_t count)> take;  ///< false: there are not so many left
    std::string problem = "libpng does not start";
};

[[noreturn]] void fail(png_structp png, png_const_charp problem) {
    static_cast<Source*>(png_get_error_ptr(png))->problem = problem;
    png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

void take_bytes(png_structp png, png_bytep bytes, std::size_t count) {
    if (!static_cast<Source*>(png_get_io_ptr(png))->take(bytes, count)) png_error(png, "it ends too soon");
}

class PngFile {
  public:
    /// How its pixels are told: as the file has them, or always as R, G, B, A of 8 bits.
    enum class Values { own, rgba8 };

    PngFile(decltype(Source::take) take, Values values) : source_{std::move(take)}, values_(values) {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source_, fail, ignore);
        info_ = png_ ? png_create_info_struct(png_) : nullptr;
    }
    ~PngFile() { png_destroy_read_struct(&png_, &info_, nullptr); }
    PngFile(const PngFile&) = delete;
    PngFile& operator=(const PngFile&) = delete;

    bool read_header() {
        return run([this] {
            png_set_read_fn(png_, &source_, take_bytes);
            // No other chunk says what the pixels are.
            constexpr png_byte kept[] = "gAMA\0sRGB";
            png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
            png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_AS_DEFAULT, kept, 2);
            png_read_info(png_, info_);
            png_set_expand(png_);  // whole bytes, colours for places in a palette
            if (values_ == Values::rgba8) {
                png_set_scale_16(png_);
                png_set_gray_to_rgb(png_);
                png_set_add_alpha(png_, 0xff, PNG_FILLER_AFTER);  // where there is none
            } else if (std::endian::native == std::endian::little) {
                png_set_swap(png_);
            }
            passes_ = png_set_interlace_handling(png_);
            png_read_update_info(png_, info_);
        });
    }
    int width() const { return static_cast<int>(png_get_image_width(png_, info_)); }
    int height() const { return static_cast<int>(png_get_image_height(png_, info_)); }
    int channels() const { return png_get_channels(png_, info_); }
    int value_bytes() const { return png_get_bit_depth(png_, info_) / 8; }
    bool is_interlaced() const { return passes_ > 1; }

    bool is_linear() const {
        constexpr double nearly = 0.01;
        int intent = 0;
        double gamma = 0;
        return !png_get_sRGB(png_, info_, &intent) && png_get_gAMA(png_, info_, &gamma) && gamma > 0 &&
               std::abs(1 / gamma - 1) <= nearly;
    }

    /// Row by row; what is interlaced only as a whole.
    bool read_pixels(std::vector<float>& pixels) {
        const auto row_bytes = png_get_rowbytes(png_, info_);
        const auto rows = static_cast<std::size_t>(height());
        std::vector<std::uint8_t> bytes(is_interlaced() ? row_bytes * rows : row_bytes);
        const auto row_values = row_bytes / static_cast<std::size_t>(value_bytes());
        return run([&] {
            for (int pass = 1; pass < passes_; ++pass)
                for (std::size_t row = 0; row < rows; ++row)
                    png_read_row(png_, bytes.data() + row * row_bytes, nullptr);
            for (std::size_t row = 0; row < rows; ++row) {
                auto* begin = bytes.data() + (is_interlaced() ? row * row_bytes : 0);
                png_read_row(png_, begin, nullptr);
                widen(begin, row_values, pixels.data() + row * row_values);
            }
        });
    }

    /// Of rgba8, into as many bytes.
    bool read_texels(std::uint8_t* texels) {
        const auto row_bytes = png_get_rowbytes(png_, info_);
        return run([&] {
            for (int pass = 0; pass < passes_; ++pass)
                for (int row = 0; row < height(); ++row)
                    png_read_row(png_, texels + static_cast<std::size_t>(row) * row_bytes, nullptr);
        });
    }

    const std::string& problem() const { return source_.problem; }

  private:
    /// False where libpng finds something wrong. Then nothing that `calls` declares is destroyed.
    template <class Calls>
    bool run(const Calls& calls) {
        if (!info_) return false;
        if (setjmp(png_jmpbuf(png_)) != 0) return false;
        calls();
        return true;
    }

    void widen(const std::uint8_t* bytes, std::size_t count, float* values) const {
        if (value_bytes() == 1)
            for (std::size_t i = 0; i < count; ++i) values[i] = float(bytes[i]) * (1.0f / UINT8_MAX);
        else
            for (std::size_t i = 0; i < count; ++i)
                values[i] = float(reinterpret_cast<const std::uint16_t*>(bytes)[i]) * (1.0f / UINT16_MAX);
    }

    Source source_;
    Values values_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    int passes_ = 1;
};

}  // namespace

DecodedImage read_png(const std::string& file, std::int64_t max_pixels, std::uint64_t max_bytes) {
    DecodedImage result;
    std::ifstream stream(file, std::ios::binary);
    const auto take = [&](std::uint8_t* to, std::size_t count) {
        return bool(stream.read(reinterpret_cast<char*>(to), static_cast<std::streamsize>(count)));
    };
    PngFile png(take, PngFile::Values::own);
    if (!png.read_header()) {
        result.error = "is not a readable image (" + png.problem() + ")";
        return result;
    }
    // The floats and, twice, the file's own values. An interlaced file keeps these until its last row; what
    // is left of them bounds the time that unpacking takes.
    const auto held = sizeof(float) + 2 * std::size_t(png.value_bytes());
    const auto pixels = std::int64_t(png.width()) * png.height();
    if (pixels > max_pixels || std::uint64_t(pixels) * std::uint64_t(png.channels()) > max_bytes / held) {
        result.error = no_sensible_size;
        return result;
    }
    result.image = Image(png.width(), png.height(), png.channels());
    if (!png.read_pixels(result.image.pixels)) result.error = "is damaged (" + png.problem() + ")";
    result.is_srgb = !png.is_linear();
    result.levels = png.value_bytes() == 1 ? UINT8_MAX : UINT16_MAX;
    result.alpha_channel = png.channels() % 2 == 0 ? png.channels() - 1 : -1;
    return result;
}

DecodedTexels decode_png(std::span<const std::uint8_t> bytes, std::int64_t max_pixels) {
    DecodedTexels result;
    const auto take = [&](std::uint8_t* to, std::size_t count) {
        if (count > bytes.size()) return false;
        std::memcpy(to, bytes.data(), count);
        bytes = bytes.subspan(count);
        return true;
    };
    PngFile png(take, PngFile::Values::rgba8);
    constexpr int channels = 4;
    if (!png.read_header() || std::int64_t{png.width()} * png.height() > max_pixels ||
        png.channels() != channels || png.value_bytes() != 1) {
        result.error = "is damaged";
        return result;
    }
    result.width = png.width();
    result.height = png.height();
    result.rgba.resize(std::size_t{channels} * std::size_t(result.width) * std::size_t(result.height));
    if (!png.read_texels(result.rgba.data())) result.error = "is damaged";
    return result;
}

}  // namespace ir
