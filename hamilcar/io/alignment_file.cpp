#include <fmt/format.h>

#include "hamilcar/io/vehicle_tables.hpp"
#include "hamilcar/suspension/alignment.hpp"

namespace hamilcar::io {

namespace {

AlignmentTargets read_targets(const TableReader& axle, const Composition& composition) {
    constexpr Range tilt{"number from -20 to 20", -20, 20};
    constexpr std::array<std::string_view, wheel_angle_names.size()> keys{"toe_in_deg", "camber_deg", "caster_deg"};
    AlignmentTargets out;
    const auto table = axle.optional_table("alignment");
    for (std::size_t i = 0; table && i < keys.size(); ++i) {
        if (!table->has(keys[i])) continue;
        out[i] = table->number(keys[i], tilt);
        axle.expect(can_set(composition, static_cast<WheelAngle>(i)), "alignment",
                    fmt::format("no {}: this suspension has nothing that sets it", keys[i]));
    }
    return out;
}

bool wants_any(const AlignmentTargets& targets) {
    return targets[0] || targets[1] || targets[2];
}

}  // namespace

void align_axle(const AxleTables& axle, const AxleSides& sides, SuspensionDescription& left,
                SuspensionDescription& right) {
    const AlignmentTargets on_left = read_targets(axle.left, sides.left);
    const AlignmentTargets on_right = axle.differ() ? read_targets(*axle.right, sides.of_right()) : on_left;
    if (axle.left.is_recording()) return;
    const auto set = [](const TableReader& table, SuspensionDescription& suspension, const Composition& composition,
                        const std::vector<AlignmentTargets>& targets) {
        const auto obstacle = align(suspension, composition, targets);
        table.expect(!obstacle, "alignment", obstacle.value_or(""));
    };
    if (!sides.hold_both()) {
        if (wants_any(on_left)) set(axle.left, left, sides.left, {on_left});
        if (wants_any(on_right)) set(axle.of_right(), right, sides.right, {on_right});
        return;
    }
    if (!wants_any(on_left) && !wants_any(on_right)) return;
    const TableReader& told = wants_any(on_left) ? axle.left : axle.of_right();
    for (std::size_t i = 0; i < on_left.size(); ++i) {
        told.expect(on_left[i].has_value() == on_right[i].has_value(), "alignment",
                    fmt::format("{} of both wheels, since one suspension carries them", wheel_angle_names[i]));
    }
    set(told, left, sides.left, {on_left, on_right});
}

}  // namespace hamilcar::io
