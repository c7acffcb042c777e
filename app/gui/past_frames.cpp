#include "app/gui/past_frames.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ir::gui {
namespace {

std::uint64_t bytes_of(const Image& image) {
    return image.pixels.size() * sizeof(float);
}

/// Lists and texts of a report are as large as a small picture.
std::uint64_t bytes_of(const FrameReport& report) {
    std::uint64_t bytes =
        report.passes.size() * sizeof(PassReport) + report.resources.size() * sizeof(ResourceReport);
    for (const auto& pass : report.passes)
        for (const auto* keys : {&pass.reads, &pass.writes, &pass.reads_previous})
            for (const auto& key : *keys) bytes += sizeof key + key.size();
    for (const auto& resource : report.resources)
        bytes += resource.key.size() + resource.label.size() + resource.doc.size() +
                 resource.fields.size() * sizeof(Field);
    return bytes;
}

std::uint64_t bytes_of(const engine::LiveResult& result) {
    std::uint64_t bytes = bytes_of(result.valid) + bytes_of(result.report);
    for (const auto& [part, image] : result.images) bytes += bytes_of(image);
    for (const auto& [key, image] : result.thumbnails) bytes += bytes_of(image);
    for (const auto& [key, buffer] : result.buffers) bytes += buffer.bytes.size();
    return bytes;
}

/// Whether only other pictures were read back of a frame.
bool is_same_frame(const PastFrame& a, const PastFrame& b) {
    return a.result->tag == b.result->tag && a.result->run == b.result->run &&
           a.computed_from == b.computed_from;
}

}  // namespace

void PastFrames::add(PastFrame frame) {
    const auto before = std::find_if(frames_.rbegin(), frames_.rend(), [&](const PastFrame& each) {
        return each.result->tag == frame.result->tag;
    });
    bytes_ += bytes_of(*frame.result);
    if (before != frames_.rend() && is_same_frame(*before, frame)) {
        bytes_ -= bytes_of(*before->result);
        before->result = std::move(frame.result);
    } else {
        frame.number = ++arrived_;
        frames_.push_back(std::move(frame));
    }
    make_room();
    emit kept_changed();
}

void PastFrames::make_room() {
    while (bytes_ > limit_ && !(frames_.empty() && aside_.empty())) {
        if (aside_.empty() && shown_ && frames_.back().number == *shown_) return;
        auto& of = aside_.empty() ? frames_ : aside_;
        const auto gone = shown_ && aside_.empty() ? std::prev(of.end()) : of.begin();
        bytes_ -= bytes_of(*gone->result);
        of.erase(gone);
    }
}

void PastFrames::set_aside(const std::function<bool(const PastFrame&)>& is_gone) {
    const auto stays = [&](const PastFrame& each) { return !is_gone(each); };
    const auto going = std::stable_partition(frames_.begin(), frames_.end(), stays);
    const auto coming = std::stable_partition(aside_.begin(), aside_.end(), is_gone);
    if (going == frames_.end() && coming == aside_.end()) return;
    std::deque<PastFrame> gone(std::make_move_iterator(going), std::make_move_iterator(frames_.end()));
    frames_.erase(going, frames_.end());
    frames_.insert(frames_.end(), std::make_move_iterator(coming), std::make_move_iterator(aside_.end()));
    aside_.erase(coming, aside_.end());
    aside_.insert(aside_.end(), std::make_move_iterator(gone.begin()), std::make_move_iterator(gone.end()));
    for (auto* list : {&frames_, &aside_})
        std::sort(list->begin(), list->end(),
                  [](const PastFrame& a, const PastFrame& b) { return a.number < b.number; });
    leave_if_past_no_more();
    emit kept_changed();
}

void PastFrames::clear() {
    if (frames_.empty() && aside_.empty()) return;
    frames_.clear();
    aside_.clear();
    bytes_ = 0;
    leave_if_past_no_more();
    emit kept_changed();
}

/// Where the frame that is shown has gone, or is the newest of all by now.
void PastFrames::leave_if_past_no_more() {
    if (shown_ && place() + 1 >= frames_.size()) show_now();
}

void PastFrames::set_limit(std::uint64_t bytes) {
    if (std::exchange(limit_, bytes) == bytes) return;
    make_room();
    emit kept_changed();
}

void PastFrames::show(std::size_t place) {
    if (place + 1 >= frames_.size()) return show_now();
    if (std::exchange(shown_, frames_[place].number) != frames_[place].number) emit shown_changed();
}

void PastFrames::show_now() {
    if (!std::exchange(shown_, std::nullopt)) return;
    make_room();  // for what did not have to go while a past frame was shown
    emit shown_changed();
    emit kept_changed();
}

std::size_t PastFrames::place() const {
    if (!shown_) return frames_.empty() ? 0 : frames_.size() - 1;
    const auto found = std::find_if(frames_.begin(), frames_.end(),
                                    [&](const PastFrame& each) { return each.number == *shown_; });
    return std::size_t(found - frames_.begin());
}

std::size_t PastFrames::place_of(const PastFrame& frame) const {
    const auto found = std::find_if(frames_.begin(), frames_.end(),
                                    [&](const PastFrame& each) { return each.number == frame.number; });
    return std::size_t(found - frames_.begin());
}

QString PastFrames::why_not_now() const {
    return is_elsewhere() ? tr("A past frame is shown; go back to the newest frame first (Alt+N).")
                          : QString();
}

const PastFrame* PastFrames::shown_of(const std::string& experiment) const {
    if (!shown_) return nullptr;
    const auto found = std::find_if(frames_.rbegin(), frames_.rend(), [&](const PastFrame& each) {
        return each.number <= *shown_ && each.result->tag == experiment;
    });
    return found == frames_.rend() ? nullptr : &*found;
}

}  // namespace ir::gui
