#pragma once

#include <map>
#include <string>

#include "projects/json.h"
#include "widgets/image/display.h"

namespace ir::gui {

/// How each buffer is shown, remembered by the buffer's key: the same buffer looks the same in every view,
/// so that colours can be compared. Pictures of light have one exposure and tone map. A view that is not
/// linked has its own.
class DisplayMemory {
  public:
    /// View -1 is the shared one.
    static constexpr int shared = -1;
    /// The key of what all pictures of light have in common; no buffer has such a key.
    static constexpr const char* light = "all:light";

    /// Null: nobody has chosen, automatic.
    const widgets::Display* chosen(const std::string& buffer, int view = shared) const;
    void choose(const std::string& buffer, const widgets::Display& display, int view = shared);
    void forget(const std::string& buffer, int view = shared);
    void clear();

    projects::Json save() const;  ///< the shared ones
    void load(const projects::Json& json);

  private:
    std::map<std::pair<int, std::string>, widgets::Display> displays_;
};

/// Whether exposure and tone map are equal, and a display with those of another one.
bool is_exposed_alike(const widgets::Display& a, const widgets::Display& b);
widgets::Display exposed_like(widgets::Display display, const widgets::Display& other);

projects::Json to_json(const widgets::Display& display);
/// What is missing or of another type keeps its default; free text in a session file never throws.
widgets::Display display_from_json(const projects::Json& json);

}  // namespace ir::gui
