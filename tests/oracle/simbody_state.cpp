// Coordinates, speeds and z-variables: what the suspensions and hitches of a CarState are in Simbody's state.

#include "tests/oracle/simbody_parts.hpp"

namespace hamilcar::oracle {

using SimTK::State;
using SimTK::Vector;

namespace {

void set_wheel(const Parts& parts, std::size_t i, const WheelState& values, State& state, Vector& z) {
    const RoadWheel& wheel = parts.wheels[i];
    const Coordinate turned{parts.bodies[wheel.wheel].body};
    turned.set(0, values.spin, state);  // a body of revolution: its angle means nothing
    for (int k = 0; k < wheel.tires(); ++k) {
        const TireState& tire = values.tires.at(static_cast<std::size_t>(k));
        z[wheel.first_z + 2 * k] = tire.u;
        z[wheel.first_z + 2 * k + 1] = tire.v;
    }
    z[wheel.windup_z()] = values.b;
}

WheelState wheel_of(const Parts& parts, std::size_t i, const State& state, const Vector& z) {
    const RoadWheel& wheel = parts.wheels[i];
    WheelState values{Coordinate{parts.bodies[wheel.wheel].body}.rate(state), z[wheel.windup_z()], {}};
    for (int k = 0; k < wheel.tires(); ++k)
        values.tires.push_back({z[wheel.first_z + 2 * k], z[wheel.first_z + 2 * k + 1]});
    return values;
}

void set_tree(const TreeParts& tree, const std::vector<double>& q, const std::vector<double>& u, State& state) {
    for (std::size_t k = 0; k < tree.coordinates.size(); ++k) tree.coordinates[k].set(q.at(k), u.at(k), state);
}

void get_tree(const TreeParts& tree, const State& state, std::vector<double>& q, std::vector<double>& u) {
    for (const Coordinate& coordinate : tree.coordinates) {
        q.push_back(coordinate.value(state));
        u.push_back(coordinate.rate(state));
    }
}

bool has_free_spindle(const Parts& parts, std::size_t i) {
    return parts.spindle_model == SpindleModel::free && is_strut(parts.description.suspensions[i]);
}

}  // namespace

void set_suspension(const Parts& parts, std::size_t i, const TreeState& values, State& state, Vector& z) {
    const SuspensionDescription& description = parts.description.suspensions[i];
    const TreeParts& tree = parts.suspensions[i];
    const TreeState own = has_free_spindle(parts, i) ? freed(description, values) : values;
    set_tree(tree, own.coordinates, own.rates, state);
    for (std::size_t w = 0; w < description.wheels.size(); ++w)
        set_wheel(parts, tree.first_wheel + w, values.wheels.at(w), state, z);
}

TreeState suspension_of(const Parts& parts, std::size_t i, const State& state, const Vector& z) {
    const SuspensionDescription& description = parts.description.suspensions[i];
    const TreeParts& tree = parts.suspensions[i];
    TreeState values;
    get_tree(tree, state, values.coordinates, values.rates);
    if (has_free_spindle(parts, i)) values = on_its_strut(description, values);
    for (std::size_t w = 0; w < description.wheels.size(); ++w)
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

}  // namespace hamilcar::oracle
