#include "widgets/space/picture_pacer.h"

namespace ir::widgets {

PicturePacer::PicturePacer(int patience, QObject* parent) : QObject(parent) {
    soon_.setSingleShot(true);
    soon_.setInterval(0);
    patience_.setSingleShot(true);
    patience_.setInterval(patience);
    connect(&soon_, &QTimer::timeout, this, &PicturePacer::send_if_possible);
    connect(&patience_, &QTimer::timeout, this, [this] {
        overdue_ = true;
        emit late();
        send_if_possible();
    });
}

void PicturePacer::want() {
    wanted_ = true;
    if (!soon_.isActive()) soon_.start();
}

void PicturePacer::answered() {
    if (waiting_) last_ms_ = clock_.elapsed();
    waiting_ = overdue_ = false;
    patience_.stop();
    if (wanted_ && !soon_.isActive()) soon_.start();
}

void PicturePacer::set_held(bool held) {
    held_ = held;
    if (!held && wanted_ && !soon_.isActive()) soon_.start();
}

void PicturePacer::send_if_possible() {
    if (!wanted_ || held_ || (waiting_ && !overdue_)) return;
    wanted_ = false;
    if (!waiting_) clock_.start();
    waiting_ = true;
    overdue_ = false;
    patience_.start();
    emit due();
}

}  // namespace ir::widgets
