#include <tbb/global_control.h>

#include <cstring>

#include "renderers/core/error.h"
#include "renderers/image/difference.h"
#include "renderers/image/metrics.h"
#include "tests/fuzz/require.h"
#include "tests/fuzz/targets/target.h"

using namespace ir;

namespace {

class Bytes {
  public:
    Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
    int below(int count) {
        std::uint8_t byte = 0;
        take(&byte, 1);
        return byte % count;
    }
    /// Values of any bits; zeros where no more bytes are left.
    Image image(int width, int height, int channels) {
        Image result(width, height, channels);
        take(result.pixels.data(), result.pixels.size() * sizeof(float));
        return result;
    }

  private:
    void take(void* to, std::size_t bytes) {
        const auto count = std::min(bytes, size_);
        if (count > 0) std::memcpy(to, data_, count);
        data_ += count;
        size_ -= count;
    }
    const std::uint8_t* data_;
    std::size_t size_;
};

}  // namespace

/// Two small pictures of any values, not-a-number and infinities among them: their metrics, or their
/// differences.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);  // rows are few
    Bytes bytes(data, size);
    const int width = 1 + bytes.below(16), rows = bytes.below(16) == 0 ? 16 : 4;
    const int height = 1 + bytes.below(rows), channels = 1 + bytes.below(4);
    const int change = bytes.below(8);  // most pairs have one size
    const bool wants_metrics = bytes.below(2) != 0;
    MetricOptions options;
    options.semantic = static_cast<Semantic>(bytes.below(4));
    const auto a = bytes.image(width, height, channels);
    const auto b = bytes.image(width + (change == 1), height, change == 2 ? 1 : channels);
    const auto valid = bytes.image(width, height, 1);
    if (bytes.below(2) != 0) options.valid_image = &valid;
    try {
        why_not_comparable(a, b, options.semantic);
        if (wants_metrics) {
            compute_metrics(a, b, metric_names(), options);
            return 0;
        }
        for (const auto& kind : difference_kinds())
            if (kind.kind != DifferenceKind::significant)
                difference(a, b, kind.kind, options.valid_image, nullptr, options.semantic);
    } catch (const UsageError& error) {
        fuzz::require_one_line(error.what());
    }
    return 0;
}
