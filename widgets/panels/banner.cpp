#include "widgets/panels/banner.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>

#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

namespace ir::widgets {
namespace {

const char* icon_of(BannerStack::Kind kind) {
    return kind == BannerStack::Kind::error     ? "error"
           : kind == BannerStack::Kind::warning ? "warning"
                                                : "note";
}

const QColor& ground_of(BannerStack::Kind kind, const ThemeColours& colours) {
    return kind == BannerStack::Kind::error     ? colours.error_ground
           : kind == BannerStack::Kind::warning ? colours.warning_ground
                                                : colours.note_ground;
}

}  // namespace

BannerStack::BannerStack(QWidget* parent) : QWidget(parent), layout_(new QVBoxLayout(this)) {
    layout_->setContentsMargins(0, 0, 0, 0);
    layout_->setSpacing(1);
}

void BannerStack::show_banner(const QString& name, Kind kind, const QString& text,
                              const std::vector<Action>& actions, bool closable) {
    hide_banner(name);
    auto* banner = new QFrame(this);
    banner->setObjectName(QStringLiteral("banner:") + name);
    set_themed_sheet(banner, [kind](const ThemeColours& colours) {
        return QStringLiteral(".QFrame { background: %1; }").arg(ground_of(kind, colours).name());
    });
    auto* row = new QHBoxLayout(banner);
    row->setContentsMargins(10, 5, 6, 5);
    auto* sign = new QLabel(banner);
    show_icon(sign, icon_of(kind), 18);
    auto* label = new QLabel(text, banner);
    label->setObjectName(QStringLiteral("text"));
    label->setWordWrap(true);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    row->addWidget(sign);
    row->addWidget(label, 1);
    for (const auto& [title, run] : actions) {
        auto* button = new QPushButton(title, banner);
        // The action may replace this very banner, so it runs after the click is over.
        connect(button, &QPushButton::clicked, this, run, Qt::QueuedConnection);
        row->addWidget(button);
    }
    if (closable) {
        auto* close = new QToolButton(banner);
        close->setIcon(icon("cancel"));
        close->setAutoRaise(true);
        close->setToolTip(tr("Dismiss"));
        close->setAccessibleName(tr("Dismiss"));
        connect(close, &QToolButton::clicked, this, [this, name] { hide_banner(name); });
        row->addWidget(close);
    }
    layout_->addWidget(banner);
}

QWidget* BannerStack::find_banner(const QString& name) const {
    return findChild<QWidget*>(QStringLiteral("banner:") + name, Qt::FindDirectChildrenOnly);
}

void BannerStack::hide_banner(const QString& name) {
    QWidget* banner = find_banner(name);
    if (!banner) return;
    banner->setObjectName({});
    banner->hide();
    layout_->removeWidget(banner);
    banner->deleteLater();
}

void BannerStack::clear() {
    for (const QString& name : names()) hide_banner(name);
}

QStringList BannerStack::names() const {
    QStringList result;
    const QString prefix = QStringLiteral("banner:");
    for (const QObject* child : children())
        if (child->objectName().startsWith(prefix)) result << child->objectName().mid(prefix.size());
    return result;
}

QString BannerStack::text(const QString& name) const {
    const QWidget* banner = find_banner(name);
    return banner ? banner->findChild<QLabel*>(QStringLiteral("text"))->text() : QString();
}

}  // namespace ir::widgets
