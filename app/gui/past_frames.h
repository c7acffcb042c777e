#pragma once

#include <QObject>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/engine/live.h"

namespace ir::gui {

/// A frame of an experiment with the pictures and buffers that were looked at when it arrived.
struct PastFrame {
    std::shared_ptr<const engine::LiveResult> result;
    projects::Experiment experiment;  ///< that asked for it
    std::string computed_from;        ///< LivePictures::computed_from()
    std::string change;               ///< what was edited before it, as undo calls it; empty: nothing
    std::uint64_t number = 0;         ///< among all frames that arrived, from 1 on
};

/// The last frames of all experiments, as many as fit into some memory, and the one of them that is shown in
/// place of what is newest. Nothing is read back for them: they are the pictures that views showed.
class PastFrames : public QObject {
    Q_OBJECT
  public:
    static constexpr std::uint64_t standard_limit = 512ull << 20;

    using QObject::QObject;
    /// The same frame with other pictures, read back because views show something else, takes the place of
    /// the one before.
    void add(PastFrame frame);
    /// Frames of what is gone are out of the way, and are back where undo brings it back.
    void set_aside(const std::function<bool(const PastFrame&)>& is_gone);
    void clear();
    /// Bytes of pictures, buffers and reports, also of those set aside. These, then the oldest frames go
    /// first. While an older frame is shown none goes: what then does not fit is not kept.
    void set_limit(std::uint64_t bytes);
    std::uint64_t limit() const { return limit_; }
    std::uint64_t bytes() const { return bytes_; }
    const std::deque<PastFrame>& frames() const { return frames_; }  ///< oldest first

    /// Shows a kept frame by its place, and of other experiments the newest that had arrived by then. The
    /// newest frame of all is now.
    void show(std::size_t place);
    void show_now();
    bool is_elsewhere() const { return shown_.has_value(); }
    /// Why not to do what would be done to the newest frame; empty: it is shown.
    QString why_not_now() const;
    std::size_t place() const;                           ///< of what is shown; of no frame where none is kept
    std::size_t place_of(const PastFrame& frame) const;  ///< that is kept
    /// What is shown of an experiment while is_elsewhere(); null: nothing of then is kept.
    const PastFrame* shown_of(const std::string& experiment) const;

  signals:
    void kept_changed();
    void shown_changed();

  private:
    void make_room();
    void leave_if_past_no_more();

    std::deque<PastFrame> frames_, aside_;  ///< oldest first
    std::uint64_t limit_ = standard_limit, bytes_ = 0, arrived_ = 0;
    std::optional<std::uint64_t> shown_;  ///< number of a kept frame
};

}  // namespace ir::gui
