#pragma once

#include <filesystem>
#include <string>

#include "app/report/make_report.h"
#include "app/report/report.h"

namespace ir::report {

/// How a page carries the values under the cursor: `automatic` takes half floats as long as the page stays
/// below its limit, and else those of the 8-bit pictures.
enum class Values { automatic, half, bytes };

struct PageOptions {
    static constexpr std::size_t usual_limit = 10'000'000;
    Values values = Values::automatic;
    std::size_t limit = usual_limit;  ///< bytes
};

/// One HTML file without anything from outside. Style and script are those of data_directory()/report. Throws
/// Error and Cancelled.
std::string html_of(const Report& report, const PageOptions& options = {}, const Work& work = {});

/// html_of(), written whole or not at all. Returns the size in bytes.
std::size_t write_html(const std::filesystem::path& file, const Report& report,
                       const PageOptions& options = {}, const Work& work = {});

}  // namespace ir::report
