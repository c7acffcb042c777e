#pragma once

#include "projects/json.h"

namespace ir::projects {

/// Looks at JSON without building a tree: what derives from it says what it wants to hear of. Beside that it
/// has less to fear of hostile texts than a parser's callback, which looks at all elements of a list whenever
/// an object in it ends.
class JsonEvents : public nlohmann::json_sax<Json> {
  public:
    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool key(string_t&) override { return true; }
    bool start_object(std::size_t) override { return true; }
    bool end_object() override { return true; }
    bool start_array(std::size_t) override { return true; }
    bool end_array() override { return true; }
    bool parse_error(std::size_t, const std::string&, const Json::exception&) override { return false; }
};

}  // namespace ir::projects
