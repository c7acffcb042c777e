#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/gui/picture_source.h"
#include "widgets/views/view_pane.h"

namespace ir::gui {

/// What a view's state means, given the document and what has been rendered: which pictures it shows, in what
/// kind of content, and what it wants of experiments. By kind of output; it knows no method.
class ViewRules {
  public:
    ViewRules(Session& session, LivePictures& live, PictureSource& pictures)
        : session_(session), live_(live), pictures_(pictures) {}

    /// An owner or output that does not exist becomes one that does; what was left open is chosen.
    widgets::ViewState completed(widgets::ViewState state) const;
    /// In their order.
    std::vector<widgets::ViewSource> pictures(const widgets::ViewState& state) const;
    /// In a row of stages the one that is right for each picture: the reference of its experiment, and for
    /// what is of none that of the first that has one. An empty owner: none. Nothing in other modes.
    std::vector<widgets::ViewSource> references(const widgets::ViewState& state) const;
    /// Those of them that pictures are compared with; an empty owner stands for each other one.
    std::vector<widgets::ViewSource> compared_references(const widgets::ViewState& state) const;
    /// Pictures and behind them their references, as widgets::ComparedPictures counts places.
    std::vector<widgets::ViewSource> places(const widgets::ViewState& state) const;
    /// All that a view needs: its pictures, and what they are compared with.
    std::vector<widgets::ViewSource> sources(const widgets::ViewState& state) const;
    bool shows(const widgets::ViewState& state, const std::string& owner) const;
    widgets::ViewPane::Content content_of(const widgets::ViewState& state) const;
    Want want_of(const widgets::ViewState& state, const std::string& owner) const;
    std::vector<widgets::Candidate> candidates(const widgets::ViewState& state) const;
    std::vector<widgets::AvailableBuffer> spatial_buffers(const std::string& owner) const;
    bool is_explanation(const widgets::ViewSource& source) const;
    QSize main_size(const std::string& owner) const;  ///< of the main result; empty: not known

    /// What a foreign image means nobody says: beside a picture of ours of as many channels, the same, and it
    /// is shown alike. Everything else means what it says itself.
    widgets::ViewSource meaning_of(const widgets::ViewState& state, const widgets::ViewSource& source) const;
    /// By which a display is remembered: a picture's, and the one that a state shows, A's or the
    /// difference's.
    std::string display_key(const widgets::ViewSource& source) const;
    std::string display_key(const widgets::ViewState& state) const;
    std::string difference_key(const widgets::ViewState& state) const;

    /// Pictures of light are exposed and mapped to what a screen can show.
    bool is_light(const widgets::ViewSource& source) const;
    bool shows_light(const widgets::ViewState& state) const;  ///< as A

    /// Why a row of stages is short, in one line; empty: it is not.
    QString missing_stages(const widgets::ViewState& state) const;

  private:
    void complete_source(widgets::ViewSource& source) const;
    void complete_stages(widgets::ViewState& state) const;
    void complete_layers(widgets::ViewState& state) const;
    widgets::ViewSource another_source(const widgets::ViewSource& a) const;

    Session& session_;
    LivePictures& live_;
    PictureSource& pictures_;
};

}  // namespace ir::gui
