#include "renderers/passes/bounce/batches.h"

#include <algorithm>

#include "renderers/graph/pass_context.h"

namespace ir::passes::bounce {
namespace {

int groups_of(int samples) {
    return (samples + group_samples - 1) / group_samples;
}

}  // namespace

Batches::Batches(graph::GraphBuilder& builder, int samples)
    : Batches(samples, builder.batches(groups_of(samples))) {}

Batches::Batches(int samples, int count) : samples_(samples) {
    const int groups = groups_of(samples);
    together_ = count == 1 ? samples : (groups + count - 1) / count * group_samples;
    for (int first = 0; first < samples; first += together_)
        all_.push_back({first, std::min(together_, samples - first)});
    if (all_.size() == 1) return;
    for (std::size_t i = 0; i < all_.size(); ++i)
        all_[i].name = " " + std::to_string(i + 1) + " of " + std::to_string(all_.size());
}

graph::ImageRef Batches::stack(graph::GraphBuilder& builder, graph::ImageDesc desc, int layers) {
    desc.layers = samples_ * layers;
    if (all_.size() == 1) return builder.image(std::move(desc));
    desc.fingerprint.clear();
    const auto key = desc.text.key;
    const auto whole = builder.image(desc);
    desc.layers = together_ * layers;
    desc.text.key += ".batch";
    desc.text.label += ", a batch";
    const auto shared = builder.image(std::move(desc));
    stacks_.push_back({shared, whole, key, layers});
    return shared;
}

graph::ImageRef Batches::whole(graph::ImageRef stack) const {
    const auto found = std::ranges::find(stacks_, stack.index, [](const Stack& s) { return s.shared.index; });
    return found == stacks_.end() ? stack : found->whole;
}

void Batches::keep(graph::GraphBuilder& builder, const Batch& batch) const {
    for (const auto& stack : stacks_)
        builder.pass("keep " + stack.key + batch.name, graph::Queue::cpu)
            .reads(stack.shared)
            .writes(stack.whole)
            .execute([=](graph::PassContext& context) {
                for (int layer = 0; layer < batch.samples * stack.layers; ++layer)
                    std::ranges::copy(
                        context.pixels<const std::byte>(stack.shared, layer),
                        context.pixels<std::byte>(stack.whole, batch.first * stack.layers + layer).begin());
            });
}

}  // namespace ir::passes::bounce
