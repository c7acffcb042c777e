#pragma once

#include <QUrl>
#include <QWidget>
#include <vector>

class QAction;
class QTextBrowser;

namespace ir::widgets {

/// A page of the manual, a Markdown file.
struct ManualPage {
    QString file, title;
    QString place;     ///< folder below the manual's, empty at the top
    QString headings;  ///< those below the title, by lines
};
/// README.md, then docs/, its folders and the other pages beside it, below `folder`. Empty where there are
/// none.
std::vector<ManualPage> manual_pages(const QString& folder);
/// Of these files the one that says most of a parameter: the first with a row of a table for it, else the
/// first that names it. Empty: none does.
QString page_with(const QStringList& files, const QString& key);

/// Shows pages of the manual. Links lead from page to page, and others to the desktop's browser.
class ManualWindow : public QWidget {
    Q_OBJECT
  public:
    explicit ManualWindow(QWidget* parent);
    /// At a parameter, where one is given.
    void show_page(const QString& file, const QString& key = {});
    /// Marks what the page says of a parameter: its row of a table, or where the text names it first. False:
    /// the page does not name it, and is shown from its top.
    bool go_to_key(const QString& key);
    QUrl page() const;

  private:
    void follow(const QUrl& link);
    /// To the heading that a link calls by its words: "what-to-expect".
    void go_to_heading(const QString& name);

    QTextBrowser* browser_;
};

}  // namespace ir::widgets
