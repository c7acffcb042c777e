#pragma once

#include "renderers/methods/all_methods.h"
#include "tests/device_fixture.h"

namespace ir::test {

/// The method on one machine, without what an experiment brings along.
class LdmAoMethodTest : public DeviceTest {
  protected:
    static const graph::Method& method() {
        for (const auto* method : methods::all_methods())
            if (method->description.id == "ldm-ao") return *method;
        throw std::logic_error("no ldm-ao");
    }
    /// Of the last frame, which wanted it.
    Image image(const std::string& key) const { return read(key); }
};

}  // namespace ir::test
