#pragma once

#include <string>
#include <vector>

#include "renderers/graph/builder.h"

namespace ir::passes::bounce {

/// Samples that the reconstruction adds up at a time: batches are whole groups, so that their number does not
/// change the order of sums.
inline constexpr int group_samples = 4;

/// Consecutive samples of all pixels.
struct Batch {
    int first = 0, samples = 0;
    std::string name = {};  ///< " 2 of 4", for passes; empty where there is one batch
};

/// How the samples of a frame are divided, so that what is kept for each of them fits the memory budget.
class Batches {
  public:
    /// All samples at once.
    explicit Batches(int samples) : Batches(samples, 1) {}
    /// As many batches as the graph asks for.
    Batches(graph::GraphBuilder& builder, int samples);

    int samples() const { return samples_; }
    int together() const { return together_; }  ///< samples of the largest batch
    const std::vector<Batch>& all() const { return all_; }

    /// Declares a stack with `layers` for each sample, sample-major. In several batches it is one that they
    /// share, and the stack of all samples is filled only for those who look at it or explain by it.
    graph::ImageRef stack(graph::GraphBuilder& builder, graph::ImageDesc desc, int layers = 1);
    /// That of all samples.
    graph::ImageRef whole(graph::ImageRef stack) const;
    /// Declares the passes that keep what a batch left in the stacks.
    void keep(graph::GraphBuilder& builder, const Batch& batch) const;

  private:
    Batches(int samples, int count);

    struct Stack {
        graph::ImageRef shared, whole;
        std::string key;
        int layers = 1;
    };
    int samples_, together_;
    std::vector<Batch> all_;
    std::vector<Stack> stacks_;
};

}  // namespace ir::passes::bounce
