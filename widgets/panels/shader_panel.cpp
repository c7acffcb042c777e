#include "widgets/panels/shader_panel.h"

#include <QFontDatabase>
#include <QLabel>
#include <QTextBrowser>
#include <QVBoxLayout>

#include "widgets/style/rich_text.h"
#include "widgets/style/theme.h"

namespace ir::widgets {
namespace {

QString html_of(const ShaderFault& fault, std::size_t number, const ThemeColours& colours) {
    auto html = QStringLiteral("<p style='margin:0 0 6px 0'>");
    if (!fault.file.empty() && fault.path.empty())
        html += QStringLiteral("<b>%1</b> ").arg(escaped(fault.place()));
    else if (!fault.file.empty())
        html += QStringLiteral("<a href='#%1'>%2</a> ").arg(number).arg(escaped(fault.place()));
    html += escaped(fault.problem);
    if (!fault.text.empty())
        html += QStringLiteral("<br><span style='font-family:\"%1\"; color:%2'>&nbsp;&nbsp;%3</span>")
                    .arg(QFontDatabase::systemFont(QFontDatabase::FixedFont).family(), colours.dim.name(),
                         escaped(fault.text));
    return html + QStringLiteral("</p>");
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
    layout->addWidget(title_);
    layout->addWidget(list_, 1);
    connect(list_, &QTextBrowser::anchorClicked, this, [this](const QUrl& link) {
        const auto number = link.fragment().toUInt();
        if (number < faults_.size()) emit place_chosen(faults_[number]);
    });
    follow_theme(this, [this] { show_faults(); });
}

void ShaderPanel::set_faults(std::vector<ShaderFault> faults) {
    if (faults == faults_) return;
    faults_ = std::move(faults);
    show_faults();
}

QString ShaderPanel::title() const {
    return title_->text();
}

void ShaderPanel::show_faults() {
    const auto number = int(faults_.size());
    title_->setText(number == 0   ? tr("All shaders that are used compile.")
                    : number == 1 ? tr("<b>One error.</b> The pictures stay those of the last shaders that "
                                       "compiled.")
                                  : tr("<b>%1 errors.</b> The pictures stay those of the last shaders that "
                                       "compiled.")
                                        .arg(number));
    QString html;
    for (std::size_t i = 0; i < faults_.size(); ++i) html += html_of(faults_[i], i, theme_colours());
    list_->setHtml(html);
}

}  // namespace ir::widgets
