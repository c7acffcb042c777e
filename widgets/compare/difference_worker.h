#pragma once

#include <QObject>
#include <limits>
#include <memory>
#include <vector>

#include "renderers/image/difference.h"
#include "widgets/image/display.h"
#include "widgets/image/picture.h"
#include "widgets/models/worker.h"

namespace ir::widgets {

/// Two pictures that have a difference (one_size.h) and what is asked about them.
struct DifferenceRequest {
    std::shared_ptr<const Picture> a, b;
    DifferenceKind kind = DifferenceKind::signed_;
    QString name_a = QStringLiteral("A"), name_b = QStringLiteral("B");  ///< in the difference's label
    /// The same pixels and the same question.
    bool same_as(const DifferenceRequest& other) const;
    /// Newer pixels for the same question: an older answer may stay on the screen meanwhile.
    bool continues(const DifferenceRequest& other) const;
};

/// Their difference, ready to be shown, and the display that its values suggest.
struct DifferenceResult {
    DifferenceRequest request;
    std::shared_ptr<const Picture> picture;
    Display automatic;
    /// Root of the mean squared A − B over all valid pixels, in the pictures' unit; NaN where there are none.
    double rmse = std::numeric_limits<double>::quiet_NaN();
};

/// Computes differences off the window's thread, one after the other in each slot. Of requests that come
/// while one is computed only the newest counts.
class DifferenceWorker : public QObject {
    Q_OBJECT
  public:
    explicit DifferenceWorker(QObject* parent = nullptr);
    ~DifferenceWorker() override;
    /// Does nothing where the slot's answer (or what is under way) is already to that.
    void request(int slot, const DifferenceRequest& request);
    /// The newest answer of a slot; null: none, or one to another question.
    const DifferenceResult* result(int slot) const;
    /// The slot's answer is not to its newest request.
    bool is_outdated(int slot) const;
    bool is_computing() const;
    void clear();

  signals:
    void ready(int slot);

  private:
    struct Slot {
        std::shared_ptr<const DifferenceResult> result;
        DifferenceRequest wanted;
        bool running = false, pending = false;
    };
    void start(int slot);
    void take(int slot, std::shared_ptr<const DifferenceResult> result);
    std::vector<Slot> slots_;
    Worker worker_;
};

/// Signed and significant: a diverging map from -m … m; absolute and squared: 0 … m; relative: 0 … 1, or to m
/// where that is less; both kinds of ꟻLIP: 0 … 1. m is the largest magnitude of the finite values.
Display display_for_difference(DifferenceKind kind, const Image& difference);
/// Its colour map.
std::string map_for_difference(DifferenceKind kind);

}  // namespace ir::widgets
