#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "app/engine/experiment.h"
#include "app/gui/image_loader.h"
#include "app/gui/kept_results.h"
#include "app/gui/past_frames.h"
#include "app/gui/remaining_time.h"
#include "app/gui/renderer.h"
#include "app/gui/session.h"

namespace ir::gui {

/// A look into the frame.
struct FrameStep {
    std::string after;                 ///< buffers are as they were when this pass had run; empty: the last
    std::optional<glm::ivec2> traced;  ///< pixel whose changes are noted, pass by pass
    bool operator==(const FrameStep&) const = default;
};

/// What somebody looks at of one experiment.
struct Want {
    std::set<engine::Part> parts;         ///< images
    std::set<std::string> buffers, kept;  ///< sent as they are; computed for 3D views
    Inspection inspection;
    FrameStep step = {};
    bool thumbnails = false;
    bool operator==(const Want&) const = default;
};

/// A moment that the timeline shows in place of the experiments' own times.
struct Moment {
    double start = 0;    ///< seconds, of the frame with which the history began
    int frames = 1;      ///< that have followed each other since, the one that is shown included
    bool plays = false;  ///< another frame follows soon
    double time() const;
    bool operator==(const Moment&) const = default;
};

/// The pictures of the experiments that are looked at: turns the document and what is wanted into requests,
/// of which the newest wins, and keeps the newest answers, and older ones in past().
class LivePictures : public QObject {
    Q_OBJECT
  public:
    enum class State { absent, blocked, rendering, done, cancelled, failed };

    LivePictures(Session& session, Renderer& renderer, ImageLoader& images, const KeptResults& kept,
                 QObject* parent = nullptr);

    /// By experiment id. Experiments that nobody wants any more are released.
    void set_wants(std::map<std::string, Want> wants);

    /// Of all experiments in which something moves; the others, and without a moment all, have their own
    /// time.
    void set_moment(std::optional<Moment> moment);
    const std::optional<Moment>& moment() const { return moment_; }
    /// Whether something moves in an experiment.
    bool is_moving(const std::string& id) const;
    /// Seconds until which a scene (its id) animates something by itself, as its files say; 0: nothing moves.
    double scene_end(const std::string& scene) const;
    /// Until when, seconds; 0: nothing moves.
    double moves_until(const std::string& id) const;
    /// Experiments that are wanted and move.
    std::vector<std::string> moving() const;

    /// Frames that were shown before. Where one of them is shown, it stands in for the newest answer in
    /// result() and computed_from(), until something else is asked for.
    PastFrames& past() { return past_; }
    const PastFrames& past() const { return past_; }

    State state(const std::string& id) const;
    const std::string& text(const std::string& id) const;                           ///< why blocked or failed
    std::shared_ptr<const engine::LiveResult> result(const std::string& id) const;  ///< may be null
    /// That is wanted of an experiment.
    const FrameStep& step(const std::string& id) const;
    /// Of result(), as step() has it; null where it was not sent.
    std::shared_ptr<const engine::BufferContents> buffer(const std::string& id, const std::string& key) const;
    /// What is newer than result() and only to be seen; null where nothing is.
    std::shared_ptr<const engine::LiveResult> draft(const std::string& id) const;
    /// Passes of the newest frame that ran on the host and could use shaders, between commas. Empty also
    /// while that is not known: the frame failed, or is of before render_again().
    QString passes_on_host(const std::string& id) const;
    /// The same text for all results of one computation: what the present one was computed from.
    const std::string& computed_from(const std::string& id) const;
    /// Of an experiment's whole run.
    struct Progress {
        QString doing;
        double fraction = 0;  ///< 0 … 1
        /// Estimated from what is done, never more than before; absent while that says nothing.
        std::optional<double> seconds_left = {};
    };
    Progress progress(const std::string& id) const;
    std::vector<std::string> rendering() const;
    bool is_settled() const { return rendering().empty(); }

    /// Whether coarser pictures are shown before the full ones.
    void set_drafts(bool on) { wants_drafts_ = on; }
    /// Bytes of the buffers of one experiment, of requests from now on; 0: any.
    void set_memory_budget(std::uint64_t bytes) { memory_budget_ = bytes; }
    void cancel();
    void render_again();  ///< everything that is wanted
    void update();        ///< asks again where the document or the camera has changed

  signals:
    void picture_arrived(const std::string& id);
    void state_changed(const std::string& id);
    void progressed(const std::string& id);
    void message(const ir::Message& message);
    /// The composition of the experiment that is worked on, whenever it is resolved.
    void composition_resolved(const std::vector<ir::scene::Part>& parts);

  private:
    struct Entry {
        Want want;
        std::string signature, text, doing;
        std::string method;  ///< id, of the experiment
        struct Sent {
            std::string picture;  ///< what is computed
            projects::Experiment experiment;
        };
        std::map<std::uint64_t, Sent> sent;  ///< by serial
        std::string computed_from;           ///< of `result`
        State state = State::absent;
        std::uint64_t serial = 0;
        std::uint64_t first_serial = 0;      ///< answers to older requests are of another life of the tag
        std::uint64_t cancelled_serial = 0;  ///< of the request that was given up
        std::optional<engine::Experiment> experiment;  ///< as the document has it, at the moment
        int frames_again = 0;                          ///< LiveRequest::frames_again
        double fraction = 0;
        bool has_begun = false;   ///< something was heard of the newest request
        RemainingTime remaining;  ///< since then
        std::shared_ptr<const engine::LiveResult> result, draft;
        std::string picture;              ///< that was asked for last
        std::size_t steps = 0;            ///< that could be undone by then
        std::size_t revision = 0;         ///< of the document by then
        std::string change;               ///< that no frame has shown yet
        std::uint64_t change_serial = 0;  ///< of the request that followed it
    };
    void update(const std::string& id, Entry& entry);
    void follow_camera();
    void send_if_changed(const std::string& id, Entry& entry);
    std::optional<engine::Experiment> resolved(const projects::Experiment& chosen);
    projects::Experiment at_moment(const projects::Experiment& chosen, int& frames_again) const;
    void send(const std::string& id, Entry& entry, const engine::Experiment& experiment);
    void note_change(const std::string& id, Entry& entry, bool is_first);
    void remember(Entry& entry, const projects::Experiment& asked);
    void set_state(const std::string& id, Entry& entry, State state, const std::string& text = {});
    void on_result(std::shared_ptr<const engine::LiveResult> result);
    void on_failure(const std::string& tag, const std::string& error, bool cancelled);
    void on_progress(const std::string& tag, const std::string& what, double fraction);
    const Entry* find(const std::string& id) const;
    double now() const { return double(clock_.elapsed()) / 1000; }  ///< seconds

    Session& session_;
    Renderer& renderer_;
    ImageLoader& images_;
    const KeptResults& kept_;
    std::map<std::string, Entry> entries_;
    PastFrames past_;
    std::size_t revision_ = 0;  ///< of the document
    std::optional<Moment> moment_;
    bool wants_drafts_ = true;
    std::uint64_t memory_budget_ = 0;
    std::string no_device_;  ///< why nothing can be rendered
    QElapsedTimer clock_;
};

/// Text that differs when the picture may: two equal ones need no new rendering.
std::string signature(const engine::Experiment& experiment);

}  // namespace ir::gui
