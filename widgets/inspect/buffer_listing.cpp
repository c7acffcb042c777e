#include <QApplication>
#include <QClipboard>
#include <QFile>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QTableView>
#include <algorithm>

#include "renderers/core/error.h"
#include "renderers/core/write_file.h"
#include "widgets/inspect/buffer_table.h"

/// Filtering, sorting, jumping, copying and saving of the table of elements.
namespace ir::widgets {

void BufferTable::read_filter() {
    const std::string text = filter_->text().trimmed().toStdString();
    std::optional<BufferFilter> filter;
    QString problem;
    try {
        if (!text.empty()) filter = parse_filter(text, model_->reader().scalars());
    } catch (const UsageError& error) {
        problem = QString::fromUtf8(error.what());
    }
    problem_->setText(problem);
    problem_->setVisible(!problem.isEmpty());
    if (!problem.isEmpty() || filter == listing_.filter) return;  // a bad filter changes nothing
    listing_.filter = filter;
    relist();
}

void BufferTable::sort_by(int column) {
    const int scalar = column == 0 ? -1 : column - 1;
    if (scalar < 0 || (listing_.sorted_by == scalar && listing_.descending)) {
        listing_.sorted_by = -1;
        listing_.descending = false;
    } else {
        listing_.descending = listing_.sorted_by == scalar;
        listing_.sorted_by = scalar;
    }
    auto* header = view_->horizontalHeader();
    header->setSortIndicatorShown(listing_.sorted_by >= 0);
    if (listing_.sorted_by >= 0)
        header->setSortIndicator(column, listing_.descending ? Qt::DescendingOrder : Qt::AscendingOrder);
    relist();
}

void BufferTable::relist() {
    ++serial_;
    if (listing_.plain()) return take(serial_, std::nullopt);
    busy_ = true;
    if (!model_->listed() && listing_.filter) {
        // All elements below a filter would be a lie until it has been applied.
        showing_ = true;
        model_->set_listed(ElementList{});
        showing_ = false;
    }
    start();
    update_status();
}

void BufferTable::start() {
    const auto list = [](const BufferReader& reader, const Listing& listing,
                         const std::atomic<bool>* cancelled) {
        ElementList elements =
            listing.filter ? filter_elements(reader, *listing.filter, cancelled)
                           : (listing.sorted_by >= 0 && reader.elements() <= max_sorted ? all_elements(reader)
                                                                                        : ElementList{});
        const bool all = !listing.filter && elements.size() < reader.elements();
        if (listing.sorted_by >= 0 && elements.size() <= max_sorted)
            sort_elements(reader, std::size_t(listing.sorted_by), listing.descending, elements);
        return all ? std::optional<ElementList>() : std::optional(std::move(elements));
    };
    if (model_->reader().elements() <= at_once)
        return take(serial_, list(model_->reader(), listing_, nullptr));
    if (running_) return;  // take() starts the newest
    running_ = true;
    worker_.start([this, list, reader = model_->reader(), listing = listing_, serial = serial_] {
        auto listed = list(reader, listing, &cancelled_);
        if (cancelled_) return;
        QMetaObject::invokeMethod(
            this,
            [this, serial, listed = std::move(listed)]() mutable {
                running_ = false;
                if (serial == serial_)
                    take(serial, std::move(listed));
                else if (busy_)
                    start();
            },
            Qt::QueuedConnection);
    });
}

void BufferTable::take(std::uint64_t serial, std::optional<ElementList> listed) {
    if (serial != serial_) return;
    busy_ = false;
    showing_ = true;
    model_->set_listed(std::move(listed));
    showing_ = false;
    if (chosen_ >= 0) show_chosen();
    update_status();
    emit settled();
}

void BufferTable::jump() {
    bool is_number = false;
    const qint64 element = element_->text().trimmed().toLongLong(&is_number);
    if (!is_number || element < 0) return element_->selectAll();
    select_element(element);
    if (model_->row_of(element) >= 0) emit element_selected(element);
}

bool BufferTable::eventFilter(QObject* watched, QEvent* event) {
    if (watched != view_ || event->type() != QEvent::KeyPress) return false;
    if (!static_cast<QKeyEvent*>(event)->matches(QKeySequence::Copy)) return false;
    copy();
    return true;
}

void BufferTable::copy() {
    constexpr int max_lines = 100'000;  // lines that a clipboard is good for
    QStringList lines{QStringLiteral("element")};
    const BufferReader& reader = model_->reader();
    for (const auto& scalar : reader.scalars()) lines.front() += '\t' + QString::fromStdString(scalar.name);
    for (const auto& range : view_->selectionModel()->selection())
        for (int row = range.top(); row <= range.bottom() && lines.size() <= max_lines; ++row) {
            const auto element = std::uint64_t(model_->element(row));
            QString line = QString::number(element);
            for (std::size_t s = 0; s < reader.scalars().size(); ++s)
                line += '\t' + QString::fromStdString(reader.text(element, s));
            lines << line;
        }
    QApplication::clipboard()->setText(lines.join('\n') + '\n');
}

void BufferTable::save_csv(const QString& file) const {
    write_file(file.toStdString(), [this](std::ostream& out) {
        to_csv(out, model_->buffer(), model_->listed() ? &*model_->listed() : nullptr);
    });
}

}  // namespace ir::widgets
