#pragma once

#include <QObject>
#include <QRect>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderers/image/metrics.h"
#include "widgets/image/picture.h"
#include "widgets/models/worker.h"

namespace ir::widgets {

/// Two pictures and what is asked about them.
struct MetricsRequest {
    std::shared_ptr<const Picture> image, reference;
    std::shared_ptr<const Picture> mask;  ///< its first channel, above 0.5 counts; null: all valid pixels
    QRect rectangle;                      ///< of whole pixels; empty: none
    /// Says which pair and mask this is; other pairs are no "before" of each other.
    std::string pair;
    /// Changes with what the pictures were computed from; later frames of one computation share it.
    std::string generation;
    bool anyway = false;  ///< also where the two look turned against each other
    /// The same pixels and the same question.
    bool same_as(const MetricsRequest& other) const;
    /// Newer pixels for the same question: what is under way may still end.
    bool continues(const MetricsRequest& other) const;
};

/// The numbers, or one line that says why there are none.
struct MetricsResult {
    MetricsRequest request;
    MetricResult image;
    std::optional<MetricResult> rectangle;
    QString refusal;
    bool may_override = false;  ///< the refusal is a suspicion: the request can be made `anyway`
    bool complete = false;      ///< false: metrics that take longer are still to come
};

/// Measures all metrics, of pictures that have a difference (compare/one_size.h) at the larger one's size.
/// Mask and rectangle are of that size. Not for the window's thread. `partial` hears of the quick ones first;
/// work ends early (incomplete) once `cancelled` is set.
MetricsResult measure(const MetricsRequest& request, const std::atomic<bool>& cancelled,
                      const std::function<void(const MetricsResult&)>& partial = {});

/// Measures away from the window's thread, one pair in each slot. Of requests that come meanwhile only the
/// newest counts; one that asks something else ends what is under way, one with newer pixels lets it finish,
/// so that slow metrics appear in a live view, too.
class MetricsWorker : public QObject {
    Q_OBJECT
  public:
    explicit MetricsWorker(QObject* parent = nullptr);
    ~MetricsWorker() override;
    /// Does nothing where the answer (or what is under way) is already to that.
    void request(std::size_t slot, const MetricsRequest& request);
    /// Nothing is asked in the slot any more.
    void clear(std::size_t slot);
    bool is_computing() const;

  signals:
    /// Null: what was under way is of no use.
    void measured(std::size_t slot, std::shared_ptr<const ir::widgets::MetricsResult> result);

  private:
    struct Slot {
        MetricsRequest wanted;
        std::shared_ptr<std::atomic<bool>> cancelled;
        bool has_wanted = false, running = false, pending = false;
    };
    void start(std::size_t slot);
    void take(std::size_t slot, std::shared_ptr<const MetricsResult> result, bool last);
    std::vector<Slot> slots_;
    Worker worker_;
};

}  // namespace ir::widgets
