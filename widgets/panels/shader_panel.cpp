#include "widgets/panels/shader_panel.h"

#include <QFontDatabase>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QTextBrowser>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/models/host_passes.h"
#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

namespace ir::widgets {
namespace {

QString html_of(const ShaderFault& fault, std::size_t number, const ThemeColours& colours) {
    auto html = QStringLiteral("<p style='margin:0 0 6px 0'>");
    if (!fault.file.empty() && fault.path.empty() && !fault.is_changed)
        html += QStringLiteral("<b>%1</b> ").arg(escaped(fault.place()));
    else if (!fault.file.empty())
        html += QStringLiteral("<a href='#%1'>%2</a> ").arg(number).arg(escaped(fault.place()));
    if (fault.is_changed) html += ShaderPanel::tr("(changed copy) ");
    html += escaped(fault.problem);
    if (!fault.text.empty())
        html += QStringLiteral("<br><span style='font-family:\"%1\"; color:%2'>&nbsp;&nbsp;%3</span>")
                    .arg(QFontDatabase::systemFont(QFontDatabase::FixedFont).family(), colours.dim.name(),
                         escaped(fault.text));
    return html + QStringLiteral("</p>");
}

/// Where a link leads, before the file that it is of.
constexpr const char* edit_link = "edit/";
constexpr const char* path_link = "path/";
constexpr const char* remove_link = "remove/";

QString html_of(const ShaderPanel::Changes::File& file, const ThemeColours& colours) {
    const auto link = [&](const char* what, const QString& text) {
        return QStringLiteral(" &nbsp; <a href='#%1%2'>%3</a>").arg(QLatin1String(what), file.name, text);
    };
    auto html = QStringLiteral("<p style='margin:4px 0 2px 0'><b>%1</b> %2").arg(file.name, file.lines) +
                link(edit_link, ShaderPanel::tr("Edit copy")) +
                (file.hunks.isEmpty() ? QString() : link(remove_link, ShaderPanel::tr("Remove change"))) +
                QStringLiteral("</p>");
    if (!file.path.isEmpty())
        html += QStringLiteral("<p style='margin:0 0 2px 0'>%1%2</p>")
                    .arg(ShaderPanel::tr("Edit and save %1").arg(file.path.toHtmlEscaped()),
                         link(path_link, ShaderPanel::tr("Copy path")));
    if (file.hunks.isEmpty()) return html;
    html += QStringLiteral("<pre style='margin:0 0 6px 0; font-family:\"%1\"'>")
                .arg(QFontDatabase::systemFont(QFontDatabase::FixedFont).family());
    // Lines of one sign are one piece: a browser takes ten times as long for many.
    const auto lines = file.hunks.split(QLatin1Char('\n'), Qt::SkipEmptyParts);
    for (auto begin = lines.begin(), end = begin; begin != lines.end(); begin = end) {
        const auto sign = begin->front();
        end = std::find_if(begin, lines.end(), [&](const auto& line) { return line.front() != sign; });
        const auto colour = sign == QLatin1Char('+')   ? colours.accent
                            : sign == QLatin1Char('-') ? colours.error
                                                       : colours.dim;
        html += QStringLiteral("<span style='color:%1'>%2\n</span>")
                    .arg(colour.name(), QStringList(begin, end).join(QLatin1Char('\n')).toHtmlEscaped());
    }
    return html + QStringLiteral("</pre>");
}

QString html_of(const ShaderPanel::Changes& changes, const ThemeColours& colours) {
    if (changes.files.empty()) return {};
    auto html = QStringLiteral("<p style='margin:6px 0 2px 0'>%1</p>")
                    .arg(ShaderPanel::tr("Edited for <b>%1</b> alone:")
                             .arg(escaped(changes.experiment.toStdString())));
    if (!changes.on_host.isEmpty())
        html += QStringLiteral("<p style='margin:2px 0; color:%1'>%2</p>")
                    .arg(colours.warning.name(), host_passes_html(changes.on_host));
    for (const auto& file : changes.files) html += html_of(file, colours);
    return html;
}

}  // namespace

ShaderPanel::ShaderPanel(const QString& folder, QWidget* parent)
    : QWidget(parent), title_(new QLabel), list_(new QTextBrowser) {
    title_->setObjectName(QStringLiteral("title"));
    title_->setWordWrap(true);
    title_->setContentsMargins(8, 4, 8, 4);
    title_->setToolTip(tr("Watched: %1").arg(folder));
    list_->setObjectName(QStringLiteral("faults"));
    list_->setAccessibleName(tr("Errors in shaders"));
    list_->setOpenLinks(false);
    list_->setFrameShape(QFrame::NoFrame);
    list_->setPlaceholderText(
        tr("Save a file in %1, and the pictures follow. What does not compile is listed here, and the "
           "pictures of the last shaders that did stay.")
            .arg(folder));
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    auto* head = new QHBoxLayout;
    head->setContentsMargins(0, 2, 4, 2);
    auto* copy = new QPushButton(tr("Edit copy …"));
    copy->setObjectName(QStringLiteral("edit-copy"));
    copy->setToolTip(tr("Change a shader for this experiment alone"));
    head->addWidget(title_, 1);
    head->addWidget(copy);
    layout->addLayout(head);
    layout->addWidget(list_, 1);
    connect(copy, &QPushButton::clicked, this, &ShaderPanel::copy_wanted);
    connect(list_, &QTextBrowser::anchorClicked, this,
            [this](const QUrl& link) { follow_link(link.fragment()); });
    follow_theme(this, [this] { show_all(); });
}

void ShaderPanel::follow_link(const QString& link) {
    if (link == QLatin1String(use_opengl_link)) return emit opengl_wanted();
    if (link.startsWith(QLatin1String(edit_link))) return emit edit_wanted(link.mid(int(qstrlen(edit_link))));
    if (link.startsWith(QLatin1String(path_link))) return emit path_wanted(link.mid(int(qstrlen(path_link))));
    if (link.startsWith(QLatin1String(remove_link)))
        return emit removal_wanted(link.mid(int(qstrlen(remove_link))));
    const auto number = link.toUInt();
    if (number < faults_.size()) emit place_chosen(faults_[number]);
}

void ShaderPanel::set_changes(Changes changes) {
    if (changes == changes_) return;
    changes_ = std::move(changes);
    show_all();
}

void ShaderPanel::set_faults(std::vector<ShaderFault> faults) {
    if (faults == faults_) return;
    faults_ = std::move(faults);
    show_all();
}

QString ShaderPanel::title() const {
    return title_->text();
}

void ShaderPanel::show_all() {
    const auto number = int(faults_.size());
    title_->setText(number == 0   ? tr("All shaders that are used compile.")
                    : number == 1 ? tr("<b>One error.</b> The pictures stay those of the last shaders that "
                                       "compiled.")
                                  : tr("<b>%1 errors.</b> The pictures stay those of the last shaders that "
                                       "compiled.")
                                        .arg(number));
    QString html;
    for (std::size_t i = 0; i < faults_.size(); ++i) html += html_of(faults_[i], i, theme_colours());
    list_->setHtml(html + html_of(changes_, theme_colours()));
}

}  // namespace ir::widgets
