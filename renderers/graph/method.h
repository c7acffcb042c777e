#pragma once

#include <functional>
#include <utility>

#include "renderers/core/method.h"
#include "renderers/graph/benchmark.h"
#include "renderers/graph/builder.h"
#include "renderers/graph/history.h"

namespace ir::graph {

/// A method that can run: its description, and a setup that declares a frame's resources and passes.
/// Resources whose keys equal those of the description's outputs are the outputs; a pixel is valid where the
/// image "valid" is not 0.
struct Method {
    MethodDescription description;
    std::function<void(GraphBuilder&, const Settings&)> setup;
    std::vector<Benchmark> benchmarks = {};
    /// Puts the part of a picture that a shard computed into `whole`, where it is missing: all of them
    /// together are what one machine has, bit for bit. Null: the method cannot be divided.
    void (*join)(History& whole, const History& part, const Shard& shard) = nullptr;
};

/// Binds a typed setup to its parameter table.
template <class Parameters>
Method make_method(MethodDescription description, ParameterTable<Parameters> table,
                   std::function<void(GraphBuilder&, const Parameters&)> setup,
                   std::vector<Benchmark> benchmarks = {}) {
    description.parameters = table.descriptions();
    return {std::move(description),
            [table = std::move(table), setup = std::move(setup)](
                GraphBuilder& builder, const Settings& settings) { setup(builder, table.typed(settings)); },
            std::move(benchmarks)};
}

}  // namespace ir::graph
