#pragma once

#include <QKeySequence>
#include <QWidget>
#include <map>
#include <string>
#include <vector>

#include "renderers/core/parameter.h"
#include "widgets/parameters/parameter_editor.h"

class QGridLayout;
class QLabel;
class QToolButton;
class QVBoxLayout;

namespace ir::widgets {

/// A form made from parameter descriptions: the transport group first, then the method's own. Rows are named
/// after their keys ("editor:KEY", "reset:KEY"), so that tests and scripts find them.
class ParameterPanel : public QWidget {
    Q_OBJECT
  public:
    /// `explained_by`: the window's key for what a parameter is, which tooltips name and the menu of a row
    /// offers beside it; empty: nothing explains them.
    explicit ParameterPanel(QWidget* parent = nullptr, const QKeySequence& explained_by = {});

    /// Rebuilds the form when the descriptions are others than before. `title`: of those that are no
    /// transport; empty: "Method".
    void set_parameters(const std::string& owner, const std::vector<ParameterDescription>& parameters,
                        const QString& title = {});
    /// Complete settings; emits nothing.
    void set_values(const Settings& settings);
    void set_read_only(bool read_only, const QString& why);
    /// Some cannot be chosen: the reasons by key.
    void set_fixed(const std::map<std::string, QString>& reasons);
    /// Hides the rows whose label, key or doc does not contain the text.
    void set_filter(const QString& text);
    /// Unfolds the section of a parameter and gives its editor the keyboard. Returns the editor; null: there
    /// is no such row.
    QWidget* show_row(const std::string& key);
    /// Of the row that has the keyboard; empty: none has.
    std::string focused_key() const;

  signals:
    void value_chosen(const std::string& key, const ir::Value& value);
    void gesture_finished();
    void reset_chosen(const std::string& key);
    void explanation_wanted(const std::string& key);
    void sweep_wanted(const std::string& key);

  protected:
    void contextMenuEvent(QContextMenuEvent* event) override;

  private:
    struct FormRow {
        QLabel* label;
        ParameterEditor* editor;
        QToolButton* reset;
    };
    void add_section(const QString& title, bool transport);
    void add_row(QGridLayout* grid, const ParameterDescription& parameter);
    void update_rows();
    /// Of the row at a place of the panel; empty: none is there.
    std::string key_at(QPoint place) const;

    std::string owner_;
    std::vector<ParameterDescription> parameters_;
    Settings settings_;
    std::map<std::string, FormRow> rows_;
    QVBoxLayout* sections_;
    QWidget* content_ = nullptr;
    const QString* why_fixed(const std::string& key) const;
    QKeySequence explained_by_;
    bool read_only_ = false;
    QString why_read_only_, filter_;
    std::map<std::string, QString> fixed_;
};

}  // namespace ir::widgets
