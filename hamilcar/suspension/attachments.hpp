// What any composition may be given besides its recipe: massless links and arms that become parts of their own, for a spring or a mass to
// sit on, and the arms of an anti-roll bar with their drop links.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hamilcar/suspension/recipe.hpp"

namespace hamilcar {

// The key of a joint or a part by its name: small letters and digits, '_' for everything else.
std::string link_key(std::string_view name);

// The keys of a composition's massless links and arms: "link_3", "upper_arm", "lower_link" of the left and the right one. Without rods
// that the rack moves.
std::vector<std::string> link_keys(const Composition& composition);

// Makes the link with that key, or both of a pair, a part on a joint of its own: an arm turns in its bushes, a link about its inner end
// without spinning about itself. Its outer end becomes a spherical cut joint.
void make_part(Composition& composition, std::string_view key);

// Half of an anti-roll bar: it turns with its arm about the lateral line through `pivot`, and a drop link leads the arm's end.
struct BarArm {
    Point pivot{}, end{}, link{};  // the drop link from the arm's end to `link` on the suspension
    std::size_t part = 1;          // that `link` sits on
};

// Adds an arm for the wheel that comes next, left first; `side` stands before the names where a composition holds both: "left ". Both
// arms turn about +y, so that their angles differ by the bar's twist.
void add_bar_arm(Composition& composition, const std::string& side, const BarArm& arm);

}  // namespace hamilcar
