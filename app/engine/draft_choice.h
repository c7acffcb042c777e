#pragma once

#include <array>
#include <optional>

#include "app/engine/live.h"

namespace ir::engine {

/// Which coarser pictures come before the full one, by how long each takes as far as is known.
class DraftChoice {
  public:
    /// Ten pictures a second follow a hand; some of each tenth is for sending and showing them.
    static constexpr double hand_ms = 85;

    /// How long a picture takes while nothing but the camera moves.
    void note(Fineness fineness, double ms) { at(fineness) = ms; }
    /// The first frame of an execution also compiles and uploads; counts where nothing better is known.
    void note_first(Fineness fineness, double ms);
    /// It was given up after so long.
    void note_given_up(Fineness fineness, double ms);
    void forget() { ms_ = {}; }

    /// With what a picture begins: the finest that lets a hand follow, else the coarsest that is worth its
    /// time. Where the surfaces are seen already, a preview says nothing new.
    Fineness first(bool is_seen_already) const;
    /// The next finer one that is worth its time; at last the full one.
    Fineness after(Fineness fineness) const;

  private:
    std::optional<double>& at(Fineness fineness) { return ms_[static_cast<std::size_t>(fineness)]; }
    std::optional<double> at(Fineness fineness) const { return ms_[static_cast<std::size_t>(fineness)]; }
    bool is_worth(Fineness fineness) const;

    std::array<std::optional<double>, 4> ms_;
};

}  // namespace ir::engine
