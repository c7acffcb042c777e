#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "widgets/image/display.h"
#include "widgets/image/picture.h"

namespace ir::widgets {

/// What there is at a pixel.
enum class Cover : std::uint8_t {
    gap = 0,       ///< between the tiles of an atlas
    hidden = 128,  ///< excluded by the picture's mask
    value = 255
};
using CoverMap = std::vector<Cover>;

/// Values that may be faults.
struct BadValues {
    bool nan = false, plus_infinity = false, minus_infinity = false, negative = false;
    void add(const BadValues& other) {
        nan |= other.nan;
        plus_infinity |= other.plus_infinity;
        minus_infinity |= other.minus_infinity;
        negative |= other.negative;
    }
};

/// What there is in a picture that a legend may have to explain.
struct Occurring {
    BadValues bad, hidden_bad;  ///< where no mask hides it, and where one does
    bool hidden = false;
    float least = 0, greatest = 0;     ///< of finite values that no mask hides
    std::vector<Category> categories;  ///< of the picture's
};

/// A picture in the form that canvases draw.
struct PreparedPicture {
    std::shared_ptr<const Picture> picture;
    std::shared_ptr<const Image> shown;     ///< at most four channels; the picture's own pixels up to four
    std::shared_ptr<const CoverMap> cover;  ///< null: a value everywhere
    std::shared_ptr<const Occurring> occurring;
    Display display;  ///< channel: of `shown`

    bool empty() const { return !shown; }
    Cover cover_at(int x, int y) const;
    /// Nothing but the display differs.
    bool same_pixels(const PreparedPicture& other) const {
        return shown == other.shown && cover == other.cover;
    }
};

/// Prepares pictures and remembers the last ones, so that switching between them costs nothing.
class PictureCache {
  public:
    PreparedPicture prepare(std::shared_ptr<const Picture> picture, const Display& display);

  private:
    struct Entry {
        std::weak_ptr<const Image> image, valid;
        bool masked = false;
        Atlas atlas;
        int channel = -1;
        std::shared_ptr<const Image> derived;  ///< null: the image itself
        std::shared_ptr<const CoverMap> cover;
        std::shared_ptr<const Occurring> occurring;
    };
    const Entry& entry_for(const Picture& picture, int channel);
    std::vector<Entry> entries_;  ///< oldest first
};

}  // namespace ir::widgets
