#pragma once

#include <map>
#include <string>

#include "projects/json.h"
#include "widgets/image/display.h"

namespace ir::gui {

/// How each buffer is shown, remembered by the buffer's key: the same buffer looks the same in every view,
/// so that colours can be compared. A view that is not linked has its own.
class DisplayMemory {
  public:
    /// View -1 is the shared one.
    static constexpr int shared = -1;

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

projects::Json to_json(const widgets::Display& display);
/// What is missing or of another type keeps its default; free text in a session file never throws.
widgets::Display display_from_json(const projects::Json& json);

}  // namespace ir::gui
