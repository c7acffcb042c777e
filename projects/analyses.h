#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "projects/document.h"

namespace ir::projects {

/// A question that an analysis may ask.
struct AnalysisKind {
    std::string key;         ///< "sensitivity"
    std::string label, doc;  ///< for lists and tooltips
    std::size_t min_experiments = 1, max_experiments = 1;
    bool needs_one_method = false, needs_reference = false, takes_parameters = false;
    /// Of two machines, which the parameters name, and judged by no reference.
    bool compares_machines = false;
    /// Of an output of the experiment's last frames, as many as the analysis says.
    bool takes_frames = false;
    bool needs_stand_ins = false;  ///< the method names exact ones
};

inline constexpr int min_analysis_frames = 2, max_analysis_frames = 64;

/// All that this build can answer.
const std::vector<AnalysisKind>& analysis_kinds();
/// Null for an unknown one.
const AnalysisKind* find_analysis_kind(const std::string& key);

/// How a machine is called: gl or host, egl or osmesa, or both with a plus. What is not named is as the
/// machine that it is asked of has it.
struct MachineName {
    std::string backend, processor;
    bool operator==(const MachineName&) const = default;
};
/// Which words a name may have, for help and messages.
inline constexpr const char* machine_words = "gl or host, egl or osmesa, or both with a plus";
/// What an analysis compares where it names none.
inline constexpr std::array<const char*, 2> default_machines{"gl", "host"};
/// Nothing for other words.
std::optional<MachineName> read_machine_name(const std::string& text);
/// Those that an analysis compares.
std::array<std::string, 2> machines_of(const Analysis& analysis);

/// Whether this is what a reference shows, too: the main result under the experiment's settings. True for an
/// experiment or a method that is not there.
bool is_main_output(const Project& project, const std::string& experiment, const std::string& output,
                    const Registry& registry);

/// Why the analysis cannot be carried out as the document has it, in one line; empty: nothing is known
/// against it.
std::string why_not_analysed(const Project& project, const Analysis& analysis, const Registry& registry);

/// An analysis of this kind about the experiment, judged by its reference. Where the kind asks about several,
/// the others are those of the same scene, camera and size, first those of the same method; its ground truth
/// is none of them. Of an output that no reference shows there is none. Throws UsageError for an unknown kind
/// or experiment.
Analysis analysis_of(const Project& project, const std::string& kind, const std::string& experiment,
                     const Registry& registry, const std::string& output = {});
/// The same; where it cannot be carried out, about the first experiment with which it can.
Analysis proposed_analysis(const Project& project, const std::string& kind, const std::string& experiment,
                           const Registry& registry);

/// Where the answer is kept: a folder relative to results/, '/' as separator, and what is in it.
std::string analysis_path(const std::string& analysis);
inline constexpr const char* analysis_file = "analysis.json";
inline constexpr const char* analysis_pictures = "pictures.exr";

}  // namespace ir::projects
