#pragma once

#include <QObject>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/gui/workspace.h"
#include "widgets/metrics/metrics_panel.h"

namespace ir::gui {

/// Keeps the metrics panel at the pairs that the active view shows: what is compared, what refuses to be, the
/// rectangle and the mask. Measures only while the panel is seen.
class MetricsDock : public QObject {
    Q_OBJECT
  public:
    MetricsDock(Session& session, LivePictures& live, Workspace& workspace);

    widgets::MetricsPanel& panel() { return *panel_; }
    void set_visible(bool visible);
    bool is_settled() const { return !panel_->is_computing(); }

    /// Masks and what is compared although it was refused.
    void save(projects::Json& memory) const;
    void load(const projects::Json& memory);

  private:
    struct Pair {
        widgets::ViewSource a, b;
        std::shared_ptr<const widgets::Picture> image, reference;
        QString name_a, name_b;   ///< "A", "B"
        std::string key() const;  ///< of the sources, not of their pixels
    };
    using Pairs = std::vector<Pair>;
    using MaskPicture = std::shared_ptr<const widgets::Picture>;
    Pairs pairs() const;
    std::vector<widgets::Option> masks(const Pairs& pairs) const;
    std::optional<widgets::ViewSource> chosen_mask(const Pairs& pairs) const;
    std::string generation(const Pair& pair) const;
    void update();
    QSize size_of(const Pair& pair) const;
    widgets::MetricsPair fields_of(const Pair& pair, const MaskPicture& mask) const;
    void send_wants(const Pairs& pairs);
    void choose_mask(const QString& id);
    bool is_accepted(const Pair& pair, const QString& refusal) const;
    void compare_anyway(int pair);

    Session& session_;
    LivePictures& live_;
    Workspace& workspace_;
    ViewModel& views_;
    widgets::MetricsPanel* panel_;
    std::map<std::string, std::string> masks_;  ///< by pairs: owner and output, as in mask_id()
    std::set<std::string> accepted_;            ///< pairs with the refusals that do not count for them
    std::map<std::string, Want> sent_;
    bool visible_ = false;
};

}  // namespace ir::gui
