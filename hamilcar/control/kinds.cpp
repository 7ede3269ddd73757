#include "hamilcar/control/kinds.hpp"

#include <algorithm>
#include <deque>
#include <stdexcept>

#include "hamilcar/base/assert.hpp"
#include "hamilcar/base/key_unit.hpp"

namespace hamilcar {

namespace {

// Pointers to entries stay as the list grows.
std::deque<ControllerKind>& list() {
    static std::deque<ControllerKind> all{external_control(), anti_lock(), traction_control(), stability_control(),
                                          active_anti_roll(), skyhook(),   torque_vectoring(), rear_steer()};
    return all;
}

}  // namespace

std::vector<const ControllerKind*> controller_kinds() {
    std::vector<const ControllerKind*> out;
    for (const ControllerKind& kind : list()) out.push_back(&kind);
    return out;
}

const ControllerKind* find_controller_kind(std::string_view keyword) {
    const auto found = std::ranges::find(list(), keyword, &ControllerKind::keyword);
    return found == list().end() ? nullptr : &*found;
}

void add_controller_kind(ControllerKind kind) {
    if (find_controller_kind(kind.keyword)) {
        throw std::invalid_argument("there is a kind of controller with the keyword " + std::string(kind.keyword));
    }
    list().push_back(std::move(kind));
}

ControllerSettings::ControllerSettings(const ControllerKind& kind, const ControllerDescription& description) {
    for (const ControllerKey& key : kind.keys) {
        const auto stated = std::ranges::find(description.settings, key.key, &std::pair<std::string, double>::first);
        const bool is_stated = stated != description.settings.end();
        values_.emplace_back(key.key, is_stated ? stated->second : key.fallback * unit_of_key(key.key).to_si);
    }
}

double ControllerSettings::operator[](std::string_view key) const {
    const auto found = std::ranges::find(values_, key, &std::pair<std::string_view, double>::first);
    HAMILCAR_ASSERT(found != values_.end());
    return found->second;
}

}  // namespace hamilcar
