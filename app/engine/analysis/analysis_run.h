#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "app/engine/analysis/analysis.h"

namespace ir::engine {

/// What analyses work with: pictures of experiments, of one size, and how far they are from each other.
/// Render thread only.
class AnalysisRun {
  public:
    AnalysisRun(Machine& machine, const projects::Project& project, const projects::Analysis& analysis,
                const std::filesystem::path& folder, const AnalysisCallbacks& callbacks);

    const projects::Project& project() const { return project_; }
    const projects::Analysis& analysis() const { return analysis_; }
    const std::filesystem::path& folder() const { return folder_; }
    Machine& machine() { return machine_; }
    /// As it runs; by its place in the analysis.
    projects::Experiment experiment(std::size_t index) const;
    const std::string& name(std::size_t index) const;  ///< of the experiment, for people
    const MethodDescription& method() const;           ///< of the first
    /// "RMSE to Reference"; without a reference the RMSE to something else: `other`.
    std::string error_title(const std::string& other) const;

    /// How many pictures will be asked for, for the progress; may be told again.
    void expect(std::size_t pictures) { expected_ = pictures; }
    /// Of one of these, with cancel, budget and progress; `what` says then what it is. It must not outlive
    /// this.
    graph::FrameOptions frame_options(std::function<std::string()> what) const;
    void count_picture() { ++done_; }  ///< one of them is there; picture() and reference() count their own
    /// The values of the main result. `what` says for the progress what it is. Throws UsageError where it
    /// has not the size and channels of those before.
    Image picture(const projects::Experiment& experiment, const std::string& what);
    /// The values of a picture that was made otherwise, of a buffer of this kind; errors are of such values
    /// from now on. Throws as picture().
    Image values(const Image& image, const Image& valid, Semantic semantic, const std::string& who);
    /// Empty where the analysis has none.
    const Image& reference();
    bool has_reference() const { return !analysis_.reference.empty(); }

    /// Over valid pixels and all channels.
    double rmse(const Image& a, const Image& b) const;
    /// The same of each pixel over its channels; 0 where either has no number, which then is not valid.
    Image distance(const Image& a, const Image& b);
    /// Mean of the channels of each pixel.
    static Image mean(const Image& image);
    /// Pixels that have values in all pictures so far; empty: all.
    const Image& valid() const { return valid_; }
    bool is_valid(std::size_t pixel) const { return valid_.empty() || valid_.pixels[pixel] > 0.5f; }
    std::size_t count_valid() const;
    void check() const;  ///< throws Cancelled

    void note(const std::string& line);  ///< what a reader of the numbers should know
    const std::vector<std::string>& notes() const { return notes_; }
    bool is_device_lost() const { return machine_.context().is_lost(); }

  private:
    void exclude(std::size_t pixel);
    void exclude_invalid(const Image& valid);
    void tell(const std::string& what, double part) const;

    Machine& machine_;
    const projects::Project& project_;
    const projects::Analysis& analysis_;
    const std::filesystem::path& folder_;
    const AnalysisCallbacks& callbacks_;
    const projects::Project now_;  ///< with the content of its files
    Semantic semantic_ = Semantic::generic;
    std::shared_ptr<graph::SharedContents> shared_;
    std::optional<Image> reference_;
    Image valid_;
    int width_ = 0, height_ = 0, channels_ = 0;
    std::size_t expected_ = 1, done_ = 0;
    std::vector<std::string> notes_;
};

// One for each kind. Throw as run_analysis().
AnalysisResult disagreement(AnalysisRun& run);
AnalysisResult sensitivity(AnalysisRun& run);
AnalysisResult attribution(AnalysisRun& run);
AnalysisResult waterfall(AnalysisRun& run);
AnalysisResult divergence(AnalysisRun& run);  // divergence.cpp
AnalysisResult last_frames(AnalysisRun& run);

}  // namespace ir::engine
