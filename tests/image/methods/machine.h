#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>

#include "app/engine/execution.h"

namespace ir::engine {

/// One machine per backend, kept between tests so that programs and scenes are loaded once.
inline std::map<std::string, std::unique_ptr<Machine>>& machines() {
    static std::map<std::string, std::unique_ptr<Machine>> all;
    return all;
}

/// Takes the machines away after the last test: once main() has returned, a driver may be unloaded.
class MachinesEnd : public testing::Environment {
    void TearDown() override { machines().clear(); }
};
inline testing::Environment* const machines_end = testing::AddGlobalTestEnvironment(new MachinesEnd);

/// That of a backend; empty: of the best that works.
inline Machine& machine(const std::string& backend = "") {
    auto& result = machines()[backend];
    if (!result) {
        MachineOptions options;
        options.backend = backend;
        result = std::make_unique<Machine>(options);
    }
    result->context().make_current();
    return *result;
}

}  // namespace ir::engine
