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

WheelMotion corner_motion(const Model<double>& model, const State<double>& state, const RackMotion<double>& rack,
                          int i) {
    const Spoke<double>& spoke = model.vehicle.spokes[static_cast<std::size_t>(i)];
    WheelMotion out;
    std::visit(
        [&](const auto& suspension) {
            constexpr int n = std::decay_t<decltype(suspension)>::Linkage::nV;
            const auto view = state.spoke(i);
            const auto at = suspension.linkage.position(view.independent, view.dependent, rack, 0.0);
            out.center = at.pose.point(spoke.wheel.center), out.axis = at.pose.direction(spoke.wheel.axis);
            for (int j = 0; j < n; ++j) {
                out.J.push_back(at.J.col(j));
                out.coordinates.push_back(hub_size + i * spoke_size + j);
            }
            out.steer = at.x;
            const auto spring = suspension.spring_line(at, view.independent);
            const auto damper = suspension.damper_line(at, view.independent);
            out.springs = {line_motion(spring, n, spoke.spring.force(spring.length))};
            out.dampers = {line_motion(damper, n, 0)};
        },
        spoke.suspension);
    out.design_center = spoke.wheel.center, out.design_axis = spoke.wheel.axis;
    out.radius = radius_of(spoke.tire), out.own_differential = false;
    return out;
}

WheelMotion composed_motion(const ComposedSpoke<double>& spoke, const ComposedPosition<double>& at,
                            const ComposedState<const double>& view, std::size_t i) {
    const ComposedWheel<double>& wheel = spoke.wheels[i];
    const int n = spoke.linkage.nV();
    const auto frame = static_cast<std::size_t>(wheel.frame);
    WheelMotion out;
    out.center = at.pose[frame].point(wheel.wheel.center), out.axis = at.pose[frame].direction(wheel.wheel.axis);
    out.design_center = wheel.wheel.center, out.design_axis = wheel.wheel.axis;
    out.radius = radius_of(wheel.tire), out.own_differential = wheel.reaction != 0;
    for (int j = 0; j < n; ++j) {
        out.J.push_back(at.motion.J[frame].col(j));
        out.coordinates.push_back(spoke.offset + j);
    }
    out.steer = at.motion.x[frame];
    for (const auto& [where, spring] : spoke.springs) {
        const auto line = spoke.linkage.line(where, at, view.independent, view.dependent);
        out.springs.push_back(line_motion(line, n, spring.force(line.length)));
    }
    for (const auto& damper : spoke.dampers) {
        out.dampers.push_back(line_motion(spoke.linkage.line(damper.line, at, view.independent, view.dependent), n, 0));
    }
    return out;
}

}  // namespace

std::vector<WheelMotion> wheel_motions(const VehicleDescription& description, const Model<double>& model,
                                       const State<double>& state, double rack) {
    const RackMotion<double> motion{rack, 1, 0};  // at a rate of one, so that the drift is a motion per unit of rack
    std::vector<WheelMotion> out;
    for (int i = 0; i < model.vehicle.spoke_count(); ++i) {
        out.push_back(corner_motion(model, state, motion, i));
        WheelMotion& wheel = out.back();
        wheel.name = description.corners[static_cast<std::size_t>(i)].name;
        wheel.springs[0].name = wheel.dampers[0].name = wheel.name;
    }
    for (std::size_t s = 0; s < model.vehicle.composed.size(); ++s) {
        const ComposedSpoke<double>& spoke = model.vehicle.composed[s];
        const auto view = spoke.state(state.values.data());
        ComposedPosition<double> at;
        spoke.linkage.find_position(view.independent, view.dependent, motion, 0.0, at);
        for (std::size_t i = 0; i < spoke.wheels.size(); ++i) {
            out.push_back(composed_motion(spoke, at, view, i));
            WheelMotion& wheel = out.back();
            wheel.name = description.composed[s].wheels[i].name;
            for (std::size_t k = 0; k < wheel.springs.size(); ++k)
                wheel.springs[k].name = description.composed[s].springs[k].name;
            for (std::size_t k = 0; k < wheel.dampers.size(); ++k)
                wheel.dampers[k].name = description.composed[s].dampers[k].name;
        }
    }
    return out;
}

}  // namespace hamilcar
