#pragma once

#include <QWidget>
#include <functional>
#include <map>
#include <string>

#include "app/gui/kept_results.h"
#include "app/gui/view_model.h"
#include "widgets/results/results_panel.h"

namespace ir::gui {

/// Keeps pictures as results of the project, and joins the table of them to session and views.
class ResultsDock : public QWidget {
    Q_OBJECT
  public:
    ResultsDock(Session& session, LivePictures& live, Renderer& renderer, ViewModel& views, KeptResults& kept,
                QWidget* parent = nullptr);
    widgets::ResultsPanel& panel() { return *panel_; }

    /// Why the shown experiment's picture cannot be kept; empty: it can.
    QString why_not_keep() const;
    /// Keeps the shown experiment's picture, once it is finished.
    void keep();
    /// A table that is not seen is not filled.
    void set_visible_to_user(bool seen);
    /// Asks a person whether so many results shall be deleted; a dialog unless another way is given.
    void set_confirm(std::function<bool(int count)> confirm) { confirm_ = std::move(confirm); }

  signals:
    void said(const QString& text);  ///< for the status line
    void failed(const QString& error);
    void keep_possible_changed();

  private:
    std::string shown() const;
    void on_kept(const engine::KeepResult& result);
    void update();
    std::vector<widgets::ResultRow> rows() const;
    QString empty_text() const;
    void show_result(const QString& key, bool as_b);
    void show_changes(const QStringList& keys);
    void remove(const QStringList& keys);
    void reveal(const QString& key);
    QString name_of(const projects::KeptResult& result) const;

    Session& session_;
    LivePictures& live_;
    Renderer& renderer_;
    ViewModel& views_;
    KeptResults& kept_;
    widgets::ResultsPanel* panel_;
    std::function<bool(int)> confirm_;
    std::map<std::string, std::filesystem::path> keeping_;  ///< by experiment: into which project
    bool seen_ = false, outdated_ = true;
};

}  // namespace ir::gui
