#pragma once

#include "renderers/methods/all_methods.h"
#include "tests/device_fixture.h"

namespace ir::test {

/// A method of layered depth maps on one machine, without what an experiment brings along.
class LdmAoMethodTest : public DeviceTest {
  protected:
    virtual std::string id() const { return "ldm-ao"; }
    const graph::Method& method() const {
        for (const auto* method : methods::all_methods())
            if (method->description.id == id()) return *method;
        throw std::logic_error("no " + id());
    }
    /// Of the last frame, which wanted it.
    Image image(const std::string& key) const { return read(key); }
};

}  // namespace ir::test
