// Coordinates, speeds and z-variables: what the suspensions and hitches of a CarState are in Simbody's state.

#include "tests/oracle/simbody_parts.hpp"

namespace hamilcar::oracle {

using SimTK::MobilizedBody;
using SimTK::State;
using SimTK::Transform;
using SimTK::Vec3;
using SimTK::Vector;

namespace {

void set_one(const MobilizedBody& body, double q, double u, State& state) {
    body.setOneQ(state, 0, q);
    body.setOneU(state, 0, u);
}

void set_spindle(const Parts& parts, std::size_t i, const Corner& values, State& state) {
    const CornerParts& bodies = parts.corners[i];
    const Linkage linkage(parts.description.corners[i]);
    const Transform pose = spindle_pose(linkage, values.independent, parts.inputs.rack);
    const SimTK::SpatialVec twist = spindle_twist(linkage, pose, values.independent_rate, parts.inputs);
    if (parts.spindle_model == SpindleModel::free) {
        bodies.carrier.setQToFitTransform(state, Transform(pose.R(), pose.p() - linkage.wheel_center));
        bodies.carrier.setUToFitVelocity(state, twist);
    } else {  // the piston rod turns with the spindle
        bodies.piston_rod.setQToFitRotation(state, pose.R());
        bodies.piston_rod.setUToFitAngularVelocity(state, twist[0]);
        set_one(bodies.carrier, values.independent, values.independent_rate, state);
    }
}

void set_wheel(const Parts& parts, std::size_t i, const WheelState& values, State& state, Vector& z) {
    const RoadWheel& wheel = parts.wheels[i];
    set_one(parts.bodies[wheel.wheel].body, 0, values.spin, state);  // a body of revolution: its angle means nothing
    for (int k = 0; k < wheel.tires(); ++k) {
        const TireState& tire = values.tires.at(static_cast<std::size_t>(k));
        z[wheel.first_z + 2 * k] = tire.u;
        z[wheel.first_z + 2 * k + 1] = tire.v;
    }
    z[wheel.windup_z()] = values.b;
}

WheelState wheel_of(const Parts& parts, std::size_t i, const State& state, const Vector& z) {
    const RoadWheel& wheel = parts.wheels[i];
    WheelState values{parts.bodies[wheel.wheel].body.getOneU(state, 0), z[wheel.windup_z()], {}};
    for (int k = 0; k < wheel.tires(); ++k)
        values.tires.push_back({z[wheel.first_z + 2 * k], z[wheel.first_z + 2 * k + 1]});
    return values;
}

void set_tree(const TreeParts& tree, const std::vector<double>& q, const std::vector<double>& u, State& state) {
    for (std::size_t k = 0; k < tree.coordinates.size(); ++k) set_one(tree.coordinates[k], q.at(k), u.at(k), state);
}

void get_tree(const TreeParts& tree, const State& state, std::vector<double>& q, std::vector<double>& u) {
    for (const MobilizedBody& coordinate : tree.coordinates) {
        q.push_back(coordinate.getOneQ(state, 0));
        u.push_back(coordinate.getOneU(state, 0));
    }
}

}  // namespace

void set_corner(const Parts& parts, std::size_t i, const Corner& values, State& state, Vector& z) {
    if (std::holds_alternative<MacPhersonDescription>(parts.description.corners[i].suspension)) {
        set_spindle(parts, i, values, state);
    } else {
        set_one(parts.corners[i].carrier, values.independent, values.independent_rate, state);
    }
    set_wheel(parts, i, {values.spin, values.b, {{values.u, values.v}}}, state, z);
}

Corner corner_of(const Parts& parts, std::size_t i, const State& state, const Vector& z) {
    const CornerDescription& description = parts.description.corners[i];
    const WheelState wheel = wheel_of(parts, i, state, z);
    Corner values{0, 0, wheel.spin, wheel.tires[0].u, wheel.tires[0].v, wheel.b};
    if (const auto* strut = std::get_if<MacPhersonDescription>(&description.suspension)) {
        const Placed& carrier = parts.bodies[parts.wheels[i].carrier];
        const MovingBody spindle(carrier.body, state), chassis(parts.chassis, state);
        const Vec3 slide = spindle.pose * carrier.station(strut->slide_point);
        const Vec3 top = chassis.pose * to_vec3(strut->strut_top);
        values.independent = (top - slide).norm();
        values.independent_rate =
            ~(top - slide) * (chassis.velocity_at(top) - spindle.velocity_at(slide)) / values.independent;
    } else {
        values.independent = parts.corners[i].carrier.getOneQ(state, 0);
        values.independent_rate = parts.corners[i].carrier.getOneU(state, 0);
    }
    return values;
}

void set_composed(const Parts& parts, std::size_t i, const TreeState& values, State& state, Vector& z) {
    const TreeParts& tree = parts.composed[i];
    set_tree(tree, values.coordinates, values.rates, state);
    for (std::size_t w = 0; w < parts.description.composed[i].wheels.size(); ++w)
        set_wheel(parts, tree.first_wheel + w, values.wheels.at(w), state, z);
}

TreeState composed_of(const Parts& parts, std::size_t i, const State& state, const Vector& z) {
    const TreeParts& tree = parts.composed[i];
    TreeState values;
    get_tree(tree, state, values.coordinates, values.rates);
    for (std::size_t w = 0; w < parts.description.composed[i].wheels.size(); ++w)
        values.wheels.push_back(wheel_of(parts, tree.first_wheel + w, state, z));
    return values;
}

void set_hitch(const Parts& parts, std::size_t i, const HitchState& values, State& state) {
    set_tree(parts.hitches[i], values.angles, values.rates, state);
}

HitchState hitch_of(const Parts& parts, std::size_t i, const State& state) {
    HitchState values;
    get_tree(parts.hitches[i], state, values.angles, values.rates);
    return values;
}

CarState design_state(const Parts& parts) {
    CarState design;
    for (const CornerDescription& corner : parts.description.corners) {
        design.corners.emplace_back();
        if (const auto* strut = std::get_if<MacPhersonDescription>(&corner.suspension))
            design.corners.back().independent = (to_vec3(strut->strut_top) - to_vec3(strut->slide_point)).norm();
    }
    for (const TreeParts& tree : parts.composed) {
        const std::vector<double> zeros(tree.coordinates.size(), 0.0);
        design.composed.push_back({zeros, zeros, {}});
    }
    for (std::size_t s = 0; s < parts.composed.size(); ++s) {
        for (std::size_t w = 0; w < parts.description.composed[s].wheels.size(); ++w) {
            const RoadWheel& wheel = parts.wheels[parts.composed[s].first_wheel + w];
            design.composed[s].wheels.push_back(
                {0, 0, std::vector<TireState>(static_cast<std::size_t>(wheel.tires()))});
        }
    }
    for (const TreeParts& hitch : parts.hitches) {
        const std::vector<double> zeros(hitch.coordinates.size(), 0.0);
        design.trailers.push_back({zeros, zeros});
    }
    return design;
}

}  // namespace hamilcar::oracle
