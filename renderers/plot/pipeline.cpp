#include "renderers/plot/pipeline.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <tuple>

#include "renderers/core/bytes_text.h"

namespace ir {
namespace {

std::string time_text(double ms) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f ms", ms < 1 ? 2 : ms < 10 ? 1 : 0, ms);
    return text;
}

std::string size_text(const ResourceReport& resource) {
    if (resource.width == 0) return std::to_string(resource.elements) + " elements of " + resource.format;
    std::string text = std::to_string(resource.width) + "×" + std::to_string(resource.height);
    if (resource.layers > 1) text += ", " + std::to_string(resource.layers) + " layers";
    if (resource.levels > 1) text += ", " + std::to_string(resource.levels) + " levels";
    return text + ", " + resource.format;
}

bool contains(const std::vector<std::string>& keys, const std::string& key) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

class Describing {
  public:
    Describing(const FrameReport& report, const PipelineContent& content)
        : report_(report), content_(content) {}

    Pipeline describe() {
        for (const auto& pass : report_.passes)
            if (content_.skipped || !pass.culled) passes_.push_back(&pass);
        if (content_.measured) measure();
        for (const auto* pass : passes_) pipeline_.nodes.push_back({true, {row_of(*pass)}});
        for (const auto& resource : report_.resources) add(resource);
        for (std::size_t g = 0; g < groups_.size(); ++g) join(groups_[g], int(passes_.size() + g));
        if (content_.marked && !content_.skipped) add_marks();
        return std::move(pipeline_);
    }

  private:
    /// Passes, by their places, that touch a buffer.
    struct Group {
        std::vector<int> writers, readers, remember;
        bool skipped = false;
        bool operator==(const Group&) const = default;
    };

    void measure() {
        for (const auto* pass : passes_)
            pipeline_.slowest_ms = std::max(pipeline_.slowest_ms, time_of(*pass));
        for (const auto& resource : report_.resources)
            pipeline_.largest_bytes = std::max(pipeline_.largest_bytes, resource.bytes);
    }

    Pipeline::Row row_of(const PassReport& pass) const {
        Pipeline::Row row{pass.name, pass.name, {}, pass.name, 0, pass.culled, false};
        if (pass.culled) {
            row.doc += "\nskipped: nobody looks at what it writes";
            return row;
        }
        row.doc += pass.queue == "gl" ? "\non the device" : "\non the host";
        if (pass.has_two_bodies) row.doc += ", which may be chosen";
        if (!content_.measured) return row;
        const double ms = time_of(pass);
        row.measured = pass.slices == 0 ? "kept" : time_text(ms);
        row.doc += pass.slices == 0 ? "\nkept: what it writes was there already" : "\n" + row.measured;
        if (pass.slices > 1) row.doc += " in " + std::to_string(pass.slices) + " slices";
        if (pipeline_.slowest_ms > 0) row.heat = ms / pipeline_.slowest_ms;
        return row;
    }

    Pipeline::Row row_of(const ResourceReport& resource, const Group& group) const {
        Pipeline::Row row{resource.key, resource.key, {}, {}, 0, group.skipped, false};
        row.pictured = resource.available && resource.width > 0 && !group.skipped;
        row.doc = resource.label.empty() ? resource.key : resource.label;
        if (content_.measured && !resource.doc.empty()) row.doc += "\n" + resource.doc;
        if (group.skipped) row.doc += "\nnot computed: nobody looks at it";
        if (resource.is_history) row.doc += "\nis there for the next frame";
        if (!content_.measured || group.skipped) return row;
        row.measured = bytes_text(resource.bytes);
        row.doc +=
            "\n" + (resource.format == "object" ? std::string() : size_text(resource) + ", ") + row.measured;
        if (pipeline_.largest_bytes > 0) row.heat = double(resource.bytes) / double(pipeline_.largest_bytes);
        return row;
    }

    Group group_of(const std::string& key) const {
        Group group;
        group.skipped = true;
        for (int p = 0; p < int(passes_.size()); ++p) {
            const auto& pass = *passes_[std::size_t(p)];
            if (contains(pass.writes, key)) group.writers.push_back(p);
            if (contains(pass.reads, key)) group.readers.push_back(p);
            if (contains(pass.reads_previous, key)) group.remember.push_back(p);
            if (contains(pass.writes, key) && !pass.culled) group.skipped = false;
        }
        return group;
    }

    void add(const ResourceReport& resource) {
        const auto group = group_of(resource.key);
        if (group.writers.empty() || (group.skipped && !content_.skipped)) return;
        const auto known = std::find(groups_.begin(), groups_.end(), group);
        const auto at = passes_.size() + std::size_t(known - groups_.begin());
        if (known == groups_.end()) {
            groups_.push_back(group);
            pipeline_.nodes.push_back({});
        }
        pipeline_.nodes[at].rows.push_back(row_of(resource, group));
    }

    void join(const Group& group, int node) {
        using Kind = Pipeline::Edge::Kind;
        const auto skips = [&](int pass) { return passes_[std::size_t(pass)]->culled; };
        for (const int pass : group.writers)
            pipeline_.edges.push_back(
                {pass, node, pass == group.writers.front() ? Kind::writes : Kind::overwrites, skips(pass)});
        for (const int pass : group.readers)
            pipeline_.edges.push_back({node, pass, Kind::reads, skips(pass)});
        for (const int pass : group.remember)
            pipeline_.edges.push_back({node, pass, Kind::remembers, skips(pass)});
    }

    /// Of a buffer that is drawn; -1: it is not.
    int node_of(const std::string& key) const {
        for (std::size_t n = passes_.size(); n < pipeline_.nodes.size(); ++n)
            for (const auto& row : pipeline_.nodes[n].rows)
                if (row.key == key) return int(n);
        return -1;
    }
    /// Of two nodes of buffers that which is written later; -1 stands for none.
    int later(int a, int b) const {
        const auto written = [&](int node) {
            return node < 0 ? -1 : groups_[std::size_t(node) - passes_.size()].writers.front();
        };
        return written(b) > written(a) ? b : a;
    }

    void add_marks() {
        std::map<std::string, int> held;  ///< node on whose mark a buffer is that is not there
        std::map<int, std::vector<std::string>> marks;
        for (const auto& pass : report_.passes) {
            if (!pass.culled) continue;
            int holder = -1;
            for (const auto* keys : {&pass.reads, &pass.reads_previous})
                for (const auto& key : *keys) {
                    const auto known = held.find(key);
                    holder = later(holder, known == held.end() ? node_of(key) : known->second);
                }
            for (const auto& key : pass.writes)
                if (node_of(key) < 0) held.emplace(key, holder);
            marks[holder].push_back(pass.name);
        }
        for (const auto& [holder, names] : marks) {
            const auto count = std::to_string(names.size());
            const auto key =
                "skipped " + (holder < 0 ? "" : pipeline_.nodes[std::size_t(holder)].rows[0].key);
            std::string doc = names.size() == 1
                                  ? "a pass is skipped, as nobody looks at what it writes:"
                                  : count + " passes are skipped, as nobody looks at what they write:";
            for (const auto& name : names) doc += "\n" + name;
            if (holder >= 0)
                pipeline_.edges.push_back(
                    {holder, int(pipeline_.nodes.size()), Pipeline::Edge::Kind::reads, true});
            pipeline_.nodes.push_back({true, {{key, "+ " + count, {}, doc, 0, true, false}}});
        }
    }

    const FrameReport& report_;
    const PipelineContent& content_;
    std::vector<const PassReport*> passes_;
    std::vector<Group> groups_;  ///< of the nodes behind the passes
    Pipeline pipeline_;
};

}  // namespace

double time_of(const PassReport& pass) {
    return pass.queue == "gl" ? pass.gpu_ms : pass.cpu_ms;
}

Pipeline pipeline_of(const FrameReport& report, const PipelineContent& content) {
    return Describing(report, content).describe();
}

bool has_same_shape(const Pipeline& a, const Pipeline& b) {
    const auto same_rows = [](const Pipeline::Node& x, const Pipeline::Node& y) {
        return x.is_pass == y.is_pass &&
               std::equal(x.rows.begin(), x.rows.end(), y.rows.begin(), y.rows.end(),
                          [](const auto& one, const auto& other) {
                              return std::tie(one.key, one.skipped, one.pictured) ==
                                     std::tie(other.key, other.skipped, other.pictured);
                          });
    };
    const auto same_edge = [](const Pipeline::Edge& x, const Pipeline::Edge& y) {
        return std::tie(x.from, x.to, x.kind) == std::tie(y.from, y.to, y.kind);
    };
    return std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(), same_rows) &&
           std::equal(a.edges.begin(), a.edges.end(), b.edges.begin(), b.edges.end(), same_edge);
}

}  // namespace ir
