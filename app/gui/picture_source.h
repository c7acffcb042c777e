#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "app/gui/kept_pictures.h"
#include "app/gui/live_pictures.h"
#include "app/gui/picture_mismatch.h"
#include "widgets/views/view_state.h"

namespace ir::gui {

/// Where in a frame its buffers are shown: "after “blur”"; empty: at its end.
QString moment_text(const std::string& pass);

/// Turns what a view asks for into what can be shown: pictures of running experiments and of files. Equal
/// questions get the same object while its content is the same.
class PictureSource {
  public:
    PictureSource(Session& session, LivePictures& live, ImageLoader& images, const KeptResults& kept)
        : session_(session),
          live_(live),
          images_(images),
          kept_(kept),
          kept_pictures_(session, images, kept),
          mismatch_(session, live, kept_pictures_) {}

    std::vector<widgets::Option> owners() const;
    bool has_owner(const std::string& owner) const;
    std::string owner_name(const std::string& owner) const;
    /// The method's outputs first, then its buffers by pass; the layers of a file, kept results among them.
    std::vector<widgets::OutputOption> outputs(const std::string& owner) const;
    /// Null when the owner has no such output.
    const widgets::OutputOption* find(const std::vector<widgets::OutputOption>& outputs,
                                      const std::string& key) const;
    /// Key of the resource behind a source: the main result has one, too.
    std::string key_of(const widgets::ViewSource& source) const;

    /// Whether something newer than what is shown of an owner is being rendered.
    bool is_stale(const std::string& owner) const;
    std::shared_ptr<const widgets::Picture> picture(const widgets::ViewSource& source);
    // In one line.
    /// Why nothing of an experiment can be shown; empty: something can.
    QString why_nothing(const std::string& owner) const;
    /// Why an output or buffer of an experiment is not there, or not of the newest frame; empty: it is.
    QString why_absent(const std::string& owner, const std::string& key) const;
    /// Why a buffer has no elements: as above, or what its description says where all went well; empty: it
    /// has some, or is an image.
    QString why_empty(const std::string& owner, const std::string& key) const;
    /// Why a buffer is not there as views of an experiment would have it, at a step within the frame.
    QString why_not_by_then(const std::string& owner, const ResourceReport& resource) const;
    /// Why an experiment will not get any further before it is finished; empty: it is finished or goes on.
    QString why_unfinished(const std::string& owner) const;
    /// How it is shown when nobody chose: by its meaning and its values.
    widgets::Display automatic_display(const widgets::ViewSource& source);
    /// What a user should know before comparing: transports that differ. Empty: nothing.
    QString warning(const widgets::ViewSource& a, const widgets::ViewSource& b) const;
    const PictureMismatch& mismatch() const { return mismatch_; }
    /// Output that holds the variance of this one; empty: there is none.
    std::string variance_key(const widgets::ViewSource& source) const;
    /// Whose pictures come with their variance, in one line.
    QString variance_hint() const;
    /// Forgets all but these: a picture keeps the whole result that it is of.
    void keep_only(const std::vector<widgets::ViewSource>& sources);
    void clear() { cache_.clear(); }

  private:
    struct Entry {
        std::shared_ptr<const widgets::Picture> picture;
        std::weak_ptr<const Image> measured;  ///< the image that `automatic` is for
        widgets::Display automatic;
    };
    using Key = std::tuple<std::string, std::string, int, int>;
    Entry& entry(const widgets::ViewSource& source);
    widgets::Picture make(const widgets::ViewSource& source) const;
    widgets::Picture of_experiment(const widgets::ViewSource& source) const;
    std::shared_ptr<const engine::LiveResult> named_frame(const std::string& owner) const;
    /// An output or buffer by its name, where that is known; else by its key.
    widgets::OutputOption option_named(const std::string& owner, const std::string& key) const;
    /// As it is asked for of a running experiment.
    engine::Part part_of(const widgets::ViewSource& source) const;
    void take_image(widgets::Picture& picture, const widgets::ViewSource& source,
                    const std::shared_ptr<const engine::LiveResult>& result) const;
    bool take_draft(widgets::Picture& picture, const widgets::ViewSource& source) const;
    void add_variance(widgets::Picture& picture, const widgets::ViewSource& source) const;
    widgets::Picture of_file(const widgets::ViewSource& source) const;
    /// Of the method's output; null for other buffers.
    const OutputDescription* description(const std::string& owner, const std::string& key) const;
    const projects::ForeignImage* foreign(const std::string& owner) const;

    Session& session_;
    LivePictures& live_;
    ImageLoader& images_;
    const KeptResults& kept_;
    KeptPictures kept_pictures_;
    PictureMismatch mismatch_;
    std::map<Key, Entry> cache_;
};

}  // namespace ir::gui
