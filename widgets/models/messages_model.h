#pragma once

#include <QAbstractTableModel>
#include <QDateTime>
#include <QSortFilterProxyModel>
#include <vector>

#include "renderers/core/report.h"

namespace ir::widgets {

/// Messages in order of arrival. One that comes again is counted, not repeated.
class MessagesModel : public QAbstractTableModel {
    Q_OBJECT
  public:
    enum Column { severity_column, time_column, source_column, text_column, column_count };
    enum Role { severity_role = Qt::UserRole, place_role, source_role };
    /// More lines than this drop the oldest.
    static constexpr std::size_t limit = 5000;

    using QAbstractTableModel::QAbstractTableModel;
    void add(const Message& message);
    void clear();
    int count(Severity severity) const;
    /// Messages by source, in the order in which sources first spoke; repeated ones count each time.
    struct SourceCount {
        std::string source;
        int count = 0;
        Severity worst = Severity::note;
    };
    std::vector<SourceCount> sources() const;
    const Message& message(int row) const { return lines_.at(std::size_t(row)).message; }
    /// The lines as text, for the clipboard.
    QString text(const QModelIndexList& rows) const;

    int rowCount(const QModelIndex& parent = {}) const override;
    int columnCount(const QModelIndex& parent = {}) const override;
    QVariant data(const QModelIndex& index, int role = Qt::DisplayRole) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

  signals:
    void counts_changed();  ///< of severities or sources

  private:
    struct Line {
        Message message;
        QDateTime time;
        int times = 1;
    };
    std::vector<Line> lines_;
};

/// Lines of the chosen severities and source that contain a text.
class MessagesFilter : public QSortFilterProxyModel {
    Q_OBJECT
  public:
    using QSortFilterProxyModel::QSortFilterProxyModel;
    void set_shown(Severity severity, bool shown);
    void set_text(const QString& text);
    /// Empty: of all sources.
    void set_source(const QString& source);
    const QString& source() const { return source_; }

  protected:
    bool filterAcceptsRow(int row, const QModelIndex& parent) const override;

  private:
    bool shown_[3] = {true, true, true};
    QString text_, source_;
};

QString severity_name(Severity severity);

}  // namespace ir::widgets
