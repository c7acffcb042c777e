#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

namespace ir::widgets {

/// Keeps requests from piling up: one is under way at a time; what is wanted meanwhile becomes one request
/// when the answer came, or after a while without one. Requests of one turn of the event loop are one, too.
class PicturePacer : public QObject {
    Q_OBJECT
  public:
    static constexpr int patience_ms = 200;
    explicit PicturePacer(int patience = patience_ms, QObject* parent = nullptr);

    void want();
    void answered();
    /// While held (hidden, no size) nothing is sent; what was wanted is sent afterwards.
    void set_held(bool held);
    /// Nothing is under way and nothing is wanted.
    bool is_idle() const { return !waiting_ && !wanted_; }
    /// Milliseconds that the last answered request took; 0 before the first.
    qint64 last_ms() const { return last_ms_; }

  signals:
    void due();
    /// An answer is overdue: what is seen is old.
    void late();

  private:
    void send_if_possible();
    QTimer soon_, patience_;
    QElapsedTimer clock_;
    qint64 last_ms_ = 0;
    bool wanted_ = false, waiting_ = false, overdue_ = false, held_ = false;
};

}  // namespace ir::widgets
