#include "widgets/panels/welcome_page.h"

#include <QCommandLinkButton>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

QLabel* heading(const QString& text, QWidget* parent) {
    auto* label = new QLabel(text, parent);
    label->setStyleSheet(QStringLiteral("font-weight: bold; color: #b8b8b8;"));
    return label;
}

QVBoxLayout* list_below(const QString& title, QGridLayout* grid, int column, QWidget* parent) {
    grid->addWidget(heading(title, parent), 2, column);
    auto* list = new QVBoxLayout;
    list->setSpacing(2);
    grid->addLayout(list, 3, column, Qt::AlignTop);
    return list;
}

}  // namespace

WelcomePage::WelcomePage(QWidget* parent) : QWidget(parent) {
    auto* content = new QWidget;
    content->setFixedWidth(640);
    auto* grid = new QGridLayout(content);
    grid->setContentsMargins(20, 20, 20, 20);
    grid->setHorizontalSpacing(40);
    grid->setVerticalSpacing(12);
    grid->setColumnStretch(0, 1);
    grid->setColumnStretch(1, 1);

    auto* title = new QLabel(tr("Interreflect"), content);
    title->setStyleSheet(QStringLiteral("font-size: 26px; font-weight: bold;"));
    auto* text = new QLabel(
        tr("Open a scene, run methods of global illumination on it,\nlook inside every buffer, and "
           "keep the whole as a project.\n\nDrop a project, a .gltf or a .glb file here."),
        content);
    grid->addWidget(title, 0, 0, 1, 2);
    grid->addWidget(text, 1, 0, 1, 2);

    auto* start = list_below(tr("Start"), grid, 0, content);
    auto* fresh = new QPushButton(icon("new"), tr("New project from a scene …"), content);
    auto* open = new QPushButton(icon("open"), tr("Open a project …"), content);
    for (auto* button : {fresh, open}) {
        button->setStyleSheet(QStringLiteral("text-align: left; padding: 4px 12px;"));
        button->setMinimumHeight(36);
        start->addWidget(button);
    }
    connect(fresh, &QPushButton::clicked, this, &WelcomePage::new_chosen);
    connect(open, &QPushButton::clicked, this, &WelcomePage::open_chosen);
    start->addSpacing(14);
    start->addWidget(heading(tr("Recent"), content));
    recent_ = new QVBoxLayout;
    recent_->setSpacing(2);
    start->addLayout(recent_);
    samples_ = list_below(tr("Sample projects"), grid, 1, content);

    auto* scroll = new QScrollArea(this);
    scroll->setWidgetResizable(true);
    auto* centred = new QWidget;
    auto* centring = new QVBoxLayout(centred);
    centring->addStretch(1);
    centring->addWidget(content, 0, Qt::AlignHCenter);
    centring->addStretch(2);
    scroll->setWidget(centred);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(scroll);
}

void WelcomePage::fill(QVBoxLayout* list, const QStringList& paths, const QString& empty) {
    while (QLayoutItem* item = list->takeAt(0)) {
        delete item->widget();
        delete item;
    }
    for (const QString& path : paths) {
        auto* button = new QPushButton(QFileInfo(path).completeBaseName());
        button->setFlat(true);
        button->setToolTip(path);
        button->setCursor(Qt::PointingHandCursor);
        button->setStyleSheet(QStringLiteral("text-align: left; padding: 4px 6px; color: #8cb8e6;"));
        connect(button, &QPushButton::clicked, this, [this, path] { emit project_chosen(path); });
        list->addWidget(button);
    }
    if (!paths.isEmpty()) return;
    auto* label = new QLabel(empty);
    label->setStyleSheet(QStringLiteral("color: #8a8a8a; padding: 4px 6px;"));
    list->addWidget(label);
}

void WelcomePage::set_samples(const QStringList& paths) {
    fill(samples_, paths, tr("This installation has no sample projects."));
}

void WelcomePage::set_recent(const QStringList& paths) {
    fill(recent_, paths, tr("Projects that you open appear here."));
}

}  // namespace ir::widgets
