#include <cstring>
#include <map>
#include <stdexcept>

#include "renderers/core/error.h"
#include "renderers/gl/device.h"

namespace ir::gl {
namespace {

/// New memory is filled with this, so that a test sees what was never written.
constexpr std::byte fresh{0xcd};

class NullDevice final : public Device {
  public:
    explicit NullDevice(NullDeviceCounts* counts) : counts_(counts ? *counts : own_counts_) {}

    Name create_image(const ImageShape& shape, const std::string&) override {
        images_[++last_name_] = {shape, std::vector<std::byte>(shape.bytes(), fresh)};
        ++counts_.images;
        return last_name_;
    }

    Name create_buffer(std::uint64_t bytes, const std::string&) override {
        buffers_[++last_name_] = std::vector<std::byte>(bytes, fresh);
        ++counts_.buffers;
        return last_name_;
    }

    void destroy_image(Name image) override {
        if (images_.erase(image) == 0) throw Error("null device: no image " + std::to_string(image));
        --counts_.images;
    }

    void destroy_buffer(Name buffer) override {
        if (buffers_.erase(buffer) == 0) throw Error("null device: no buffer " + std::to_string(buffer));
        --counts_.buffers;
    }

    void clear_image(Name image, const ImageShape& shape) override {
        auto& texels = find_image(image, shape);
        if (!info(shape.format).depth) {
            std::fill(texels.begin(), texels.end(), std::byte{0});
            return;
        }
        const float far = 1;
        for (std::size_t i = 0; i + sizeof far <= texels.size(); i += sizeof far)
            std::memcpy(&texels[i], &far, sizeof far);
    }

    void clear_buffer(Name buffer, std::uint64_t offset, std::uint64_t bytes) override {
        const auto range = buffer_range(buffer, offset, bytes);
        std::fill(range.begin(), range.end(), std::byte{0});
    }

    void read_image(Name image, const ImageShape& shape, int level, int layer,
                    std::span<std::byte> to) override {
        const auto range = image_range(image, shape, level, layer, to.size());
        std::copy(range.begin(), range.end(), to.begin());
    }

    void read_texel(Name image, const ImageShape& shape, int level, int layer, int x, int y,
                    std::span<std::byte> to) override {
        const int width = shape.level_width(level), height = shape.level_height(level);
        const auto bytes = static_cast<std::size_t>(info(shape.format).bytes);
        const auto range = image_range(image, shape, level, layer, bytes * width * height);
        const auto texel = range.subspan(bytes * (static_cast<std::size_t>(y) * width + x), to.size());
        std::copy(texel.begin(), texel.end(), to.begin());
    }

    void write_image(Name image, const ImageShape& shape, int level, int layer,
                     std::span<const std::byte> from) override {
        const auto range = image_range(image, shape, level, layer, from.size());
        std::copy(from.begin(), from.end(), range.begin());
    }

    void read_buffer(Name buffer, std::uint64_t offset, std::span<std::byte> to) override {
        const auto range = buffer_range(buffer, offset, to.size());
        std::copy(range.begin(), range.end(), to.begin());
    }

    void write_buffer(Name buffer, std::uint64_t offset, std::span<const std::byte> from) override {
        const auto range = buffer_range(buffer, offset, from.size());
        std::copy(from.begin(), from.end(), range.begin());
    }

    void finish() override { ++counts_.finishes; }
    void begin_pass(const std::string&) override { ++open_passes_; }
    int end_pass() override {
        if (open_passes_-- == 0) throw Error("a pass ends that did not begin");
        return counts_.passes++;
    }
    double pass_ms(int) override { return 0; }
    void barrier() override {}
    std::string backend() const override { return "null"; }
    std::string device() const override { return "host memory"; }
    bool software() const override { return true; }
    std::uint64_t max_buffer_bytes() const override { return 1ull << 40; }

  private:
    struct Image {
        ImageShape shape;
        std::vector<std::byte> texels;  ///< levels from large to small, layers within each
    };

    std::vector<std::byte>& find_image(Name name, const ImageShape& shape) {
        const auto found = images_.find(name);
        if (found == images_.end()) throw Error("null device: no image " + std::to_string(name));
        if (found->second.shape != shape) throw Error("null device: the image has another shape");
        return found->second.texels;
    }

    std::span<std::byte> image_range(Name name, const ImageShape& shape, int level, int layer,
                                     std::size_t bytes) {
        auto& texels = find_image(name, shape);
        const int layers = std::max(1, shape.layers);
        if (level < 0 || level >= shape.levels || layer < 0 || layer >= layers)
            throw std::out_of_range("image has no such level or layer");
        ImageShape larger = shape;
        larger.levels = level;
        ImageShape slice{shape.level_width(level), shape.level_height(level), 1, 0, shape.format};
        if (bytes != slice.bytes()) throw std::invalid_argument("memory does not fit the image level");
        return std::span(texels).subspan(larger.bytes() + static_cast<std::size_t>(layer) * slice.bytes(),
                                         bytes);
    }

    std::span<std::byte> buffer_range(Name name, std::uint64_t offset, std::uint64_t bytes) {
        const auto found = buffers_.find(name);
        if (found == buffers_.end()) throw Error("null device: no buffer " + std::to_string(name));
        if (offset > found->second.size() || bytes > found->second.size() - offset)
            throw std::out_of_range("range is outside of the buffer");
        return std::span(found->second).subspan(offset, bytes);
    }

    NullDeviceCounts own_counts_;
    NullDeviceCounts& counts_;
    std::map<Name, Image> images_;
    std::map<Name, std::vector<std::byte>> buffers_;
    Name last_name_ = 0;
    int open_passes_ = 0;
};

}  // namespace

std::unique_ptr<Device> make_null_device(NullDeviceCounts* counts) {
    return std::make_unique<NullDevice>(counts);
}

}  // namespace ir::gl
