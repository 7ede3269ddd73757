#include "hamilcar/analysis/wheel_motion.hpp"

namespace hamilcar {

namespace {

template <class Line>
LineMotion line_motion(const Line& line, int n, double force) {
    LineMotion out{{}, line.length, {}, force};
    for (int j = 0; j < n; ++j) out.gradient.push_back(line.gradient[static_cast<std::size_t>(j)]);
    return out;
}

double radius_of(const Tire<double>& tire) {
    return std::visit([](const auto& model) { return model.radius; }, tire);
}

WheelMotion motion_of(const Suspension<double>& suspension, const LinkagePosition<double>& at,
                      const SuspensionState<const double>& view, std::size_t i) {
    const SuspensionWheel<double>& wheel = suspension.wheels[i];
    const int n = suspension.linkage.nV();
    const auto frame = static_cast<std::size_t>(wheel.frame);
    WheelMotion out;
    out.center = at.pose[frame].point(wheel.wheel.center), out.axis = at.pose[frame].direction(wheel.wheel.axis);
    out.design_center = wheel.wheel.center, out.design_axis = wheel.wheel.axis;
    out.radius = radius_of(wheel.tire), out.own_differential = wheel.reaction != 0;
    for (int j = 0; j < n; ++j) {
        out.J.push_back(at.motion.J[frame].col(j));
        out.coordinates.push_back(suspension.offset + j);
    }
    (suspension.steered_by < 0 ? out.steer : out.own_steer) = at.motion.x[frame];
    for (int j = 0; j < n && wheel.bar_arm >= 0; ++j) {
        out.bar_arm.push_back(at.Y[static_cast<std::size_t>(wheel.bar_arm)][static_cast<std::size_t>(j)]);
    }
    for (const auto& [where, spring] : suspension.springs) {
        const auto line = suspension.linkage.line(where, at, view.independent, view.dependent);
        out.springs.push_back(line_motion(line, n, spring.force(line.length)));
    }
    for (const auto& damper : suspension.dampers) {
        out.dampers.push_back(
            line_motion(suspension.linkage.line(damper.line, at, view.independent, view.dependent), n, 0));
    }
    return out;
}

}  // namespace

std::vector<WheelMotion> wheel_motions(const VehicleDescription& description, const Model<double>& model,
                                       const State<double>& state, double rack) {
    std::vector<WheelMotion> out;
    for (std::size_t s = 0; s < model.vehicle.suspensions.size(); ++s) {
        const Suspension<double>& suspension = model.vehicle.suspensions[s];
        const auto view = suspension.state(state.values.data());
        LinkagePosition<double> at;
        RackMotion<double> motion = rack_at(model.vehicle, suspension, {rack, 0, 0}, state.values.data());
        motion.rate = 1;  // so that prescribed rates are motions per unit of rack
        suspension.linkage.find_position(view.independent, view.dependent, motion, 0.0, at);
        for (std::size_t i = 0; i < suspension.wheels.size(); ++i) {
            out.push_back(motion_of(suspension, at, view, i));
            WheelMotion& wheel = out.back();
            wheel.name = description.suspensions[s].wheels[i].name;
            for (std::size_t k = 0; k < wheel.springs.size(); ++k)
                wheel.springs[k].name = description.suspensions[s].springs[k].name;
            for (std::size_t k = 0; k < wheel.dampers.size(); ++k)
                wheel.dampers[k].name = description.suspensions[s].dampers[k].name;
        }
    }
    return out;
}

}  // namespace hamilcar
