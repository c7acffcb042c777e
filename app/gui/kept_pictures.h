#pragma once

#include <QStringList>
#include <optional>
#include <string>
#include <vector>

#include "app/gui/image_loader.h"
#include "app/gui/kept_results.h"
#include "app/gui/session.h"
#include "widgets/views/view_state.h"

namespace ir::gui {

/// What views call a kept result: "result:KEY".
inline std::string kept_owner(const std::string& key) {
    return "result:" + key;
}
inline bool is_kept_owner(const std::string& owner) {
    return owner.rfind("result:", 0) == 0;
}
/// The result's key of such a name.
inline std::string kept_key(const std::string& owner) {
    return owner.substr(7);
}

/// Pictures of kept results: the same questions that experiments answer, asked of the files.
class KeptPictures {
  public:
    KeptPictures(Session& session, ImageLoader& images, const KeptResults& kept)
        : session_(session), images_(images), kept_(kept) {}

    const projects::KeptResult* find(const std::string& owner) const;  ///< null: it is none, or is gone
    std::string name(const projects::KeptResult& result) const;
    std::vector<widgets::OutputOption> outputs(const projects::KeptResult& result) const;
    /// What the method says about an output; null where this build does not know it.
    const OutputDescription* output(const projects::KeptResult& result, const std::string& key) const;
    /// Seconds at which its last frame saw the scene.
    double moment(const projects::KeptResult& result) const;
    widgets::Picture picture(const widgets::ViewSource& source) const;
    /// Which inputs of two owners differ that both pictures depend on; absent where somebody's are not known.
    std::optional<QStringList> different_inputs(const std::string& a, const std::string& b) const;

  private:
    Session& session_;
    ImageLoader& images_;
    const KeptResults& kept_;
};

}  // namespace ir::gui
