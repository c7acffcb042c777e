#pragma once

#include <QImage>
#include <QObject>
#include <compare>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "widgets/image/display.h"
#include "widgets/models/newest_job.h"

namespace ir::widgets {

/// What a contact sheet shows of a variation: its picture, or that minus its reference.
struct SheetRequest {
    QString picture, reference;  ///< EXR files; a reference is given for differences alone
    QString version;             ///< another one: the files hold another picture
    std::strong_ordering operator<=>(const SheetRequest&) const = default;
    bool operator==(const SheetRequest&) const = default;
};

/// Reads pictures of contact sheets away from the window's thread, and keeps the last ones in so many bytes.
/// All have one display, and all differences another one, so that they can be compared: the exposure of the
/// first picture, and the greatest extent of all differences, rounded up to a power of two.
class SheetPictures : public QObject {
    Q_OBJECT
  public:
    static constexpr std::size_t usual_bytes = std::size_t{192} << 20;

    explicit SheetPictures(std::size_t max_bytes = usual_bytes, QObject* parent = nullptr);

    /// Of what the pictures are; everything is read anew.
    void set_semantic(Semantic semantic);
    /// Of another sweep: the first picture gives the exposure, and differences have no extent yet.
    void restart();
    /// Stops beside those of the first picture.
    void set_exposure(double stops);
    /// What is seen now, from the first on. All else may be forgotten, and is not read any more.
    void want(std::vector<SheetRequest> requests);
    /// Null: it is not there yet, or cannot be read.
    const QImage* find(const SheetRequest& request) const;
    /// Why it cannot be read, in one line; empty: nothing is known against it.
    QString problem(const SheetRequest& request) const;

    std::size_t bytes() const { return bytes_; }
    bool is_reading() const { return job_.is_running(); }
    int read_count() const { return read_count_; }
    /// Colours of differences go from minus to plus this; 0: there was none yet.
    double extent() const { return extent_; }
    bool is_colour() const { return display_ && display_->mode == Display::Mode::colour; }

  signals:
    void arrived();

  private:
    struct Entry {
        QImage image;
        QString problem;
        std::size_t used = 0;  ///< when it was wanted last
    };
    struct Look {
        Semantic semantic = Semantic::radiance;
        std::optional<Display> display;  ///< of the first picture
        double stops = 0, extent = 0;
        std::size_t max_pixels = 0;
        int serial = 0;
    };
    struct Reference;
    static Entry read(const SheetRequest& request, Look& look, Reference& reference);
    void read_next();
    void take(const SheetRequest& request, Entry entry, const Look& look);
    void forget_all();
    /// Differences, or pictures: they are to be read again.
    void drop(bool are_differences);
    void drop_oldest();

    const std::size_t max_bytes_;
    Semantic semantic_ = Semantic::radiance;
    std::optional<Display> display_;
    double stops_ = 0, extent_ = 0;
    std::vector<SheetRequest> wanted_;
    std::map<SheetRequest, Entry> entries_;
    std::size_t bytes_ = 0, clock_ = 0;
    int serial_ = 0, read_count_ = 0;
    std::shared_ptr<Reference> reference_;  ///< the last one that was read; of the job alone
    NewestJob job_;                         // last member: its thread uses the others
};

}  // namespace ir::widgets
