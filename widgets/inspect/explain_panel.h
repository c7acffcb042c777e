#pragma once

#include <QPoint>
#include <QString>
#include <QWidget>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderers/core/report.h"

class QLabel;
class QPushButton;
class QVBoxLayout;

namespace ir::widgets {

/// A buffer that explains a pixel or an item.
struct ExplainOutput {
    std::string key;
    QString label, kind, doc;  ///< kind: "point_set", as core names it
    qint64 elements = -1;      ///< -1: not known, or an image
    bool available = false;    ///< false: not computed yet
    QString why_none = {};     ///< why it is not there, or has no elements for this pixel
    bool operator==(const ExplainOutput&) const = default;
};

/// Something of which a method shows one by one.
struct ExplainSelector {
    std::string key;
    QString label, doc;
    int count = 0;   ///< items 0 … count − 1
    int chosen = 0;  ///< Inspection::all: all of them
    bool operator==(const ExplainSelector&) const = default;
};

/// What the method says about one pixel, and which of its items it shows.
class ExplainPanel : public QWidget {
    Q_OBJECT
  public:
    explicit ExplainPanel(QWidget* parent = nullptr);
    /// All at once; emits nothing. Without a pixel the buffers are listed, but cannot be shown.
    void set_content(std::optional<QPoint> pixel, const std::vector<ExplainOutput>& outputs,
                     const std::vector<ExplainSelector>& selectors);

    /// What shaders print of the pixel; `can_print`: whether they would.
    void set_printed(bool can_print, const std::vector<PrintedValue>& printed);
    /// Passes (between commas) whose shaders are changed and say nothing, because they run on the host.
    void set_on_host(const QString& passes);

  signals:
    void opengl_wanted();  ///< in place of the host
    void show_wanted(const QString& key);
    void item_chosen(const QString& selector, int item);  ///< Inspection::all: all
    void pixel_cleared();                                 ///< explain nothing any longer

  private:
    /// Widgets of the lists as long as their shape stays, so that focus and clicks survive each frame.
    struct OutputRow;
    struct SelectorRow;
    void build();
    QWidget* make_output(std::size_t number);
    QWidget* make_selector(std::size_t number);
    void update_pixel();
    void update_printed();

    std::optional<QPoint> pixel_;
    std::vector<ExplainOutput> outputs_;
    std::vector<ExplainSelector> selectors_;
    bool can_print_ = false;
    std::vector<PrintedValue> printed_;
    QLabel *title_ = nullptr, *help_ = nullptr, *printed_text_ = nullptr, *on_host_ = nullptr;
    QPushButton* clear_ = nullptr;
    QVBoxLayout* lists_ = nullptr;
    QWidget* content_ = nullptr;
    std::vector<std::shared_ptr<OutputRow>> output_rows_;
    std::vector<std::shared_ptr<SelectorRow>> selector_rows_;
};

}  // namespace ir::widgets
